#include "tools/report/gl/context.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "models/foundation/bad_input.h"

namespace warmjoint::report {
namespace {

using ::testing::HasSubstr;

/// Sets an environment variable for as long as it lives.
class Variable {
 public:
  explicit Variable(const char* value) { setenv("WARMJOINT_GL", value, 1); }
  ~Variable() { unsetenv("WARMJOINT_GL"); }
};

TEST(GlContext, IsTheOneThatTheVariableForces) {
  {
    Variable forced("osmesa");
    EXPECT_EQ(MakeGlContext()->Name(), "osmesa");
  }
  if (!MakeEglContext()) GTEST_SKIP() << "this machine has no EGL without a display";
  Variable forced("egl");
  EXPECT_THAT(MakeGlContext()->Name(), HasSubstr("egl"));
}

TEST(GlContext, RefusesAnUnknownKind) {
  Variable forced("osmessa");
  try {
    MakeGlContext();
    FAIL() << "accepted";
  } catch (const BadInput& refusal) {
    EXPECT_THAT(refusal.what(), HasSubstr("WARMJOINT_GL: unknown value 'osmessa'; did you mean"));
  }
}

}  // namespace
}  // namespace warmjoint::report
