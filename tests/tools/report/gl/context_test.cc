#include "tools/report/gl/context.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "models/foundation/bad_input.h"
#include "tests/tools/report/look.h"
#include "tools/report/figures/error_by_iteration.h"

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

TEST(GlContext, OfEitherKindDrawsTheSamePicture) {
  auto egl = MakeEglContext();
  if (!egl) GTEST_SKIP() << "this machine has no EGL without a display";
  ErrorByIteration data;
  data.suite = "two contexts";
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(50, 1, 50);
  const QuartileCurve curve{x, x.cwiseInverse(), 2 * x.cwiseInverse(), 3 * x.cwiseInverse()};
  data.identifiers = {{"energy-em", "energy-em", curve, curve}};
  const Figure figure = MakeErrorByIteration(data);

  const Image a = DrawFigure(TestCanvas(), figure).image;
  Canvas other(std::move(egl));
  const Image b = DrawFigure(other, figure).image;
  int differing = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x_pixel = 0; x_pixel < a.width; ++x_pixel) {
      differing += Distance(a.At(x_pixel, y), b.At(x_pixel, y)) > 8;
    }
  }
  EXPECT_LE(differing, a.width * a.height / 100) << "more than 1 % of the pixels";
}

}  // namespace
}  // namespace warmjoint::report
