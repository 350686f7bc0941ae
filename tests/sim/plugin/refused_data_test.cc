// Data that an instance refuses, with engines that are known and others.
#include "sim/plugin/register.h"

#include <gmock/gmock.h>

#include "tests/sim/plugin/friction_models.h"
#include "tests/sim/plugin/warnings.h"

namespace warmjoint {
namespace {

using namespace test;

TEST(RefusedData, KnowsTheEngineThatItIsBuiltWith) {
  // an upgrade of MuJoCo ends here: read how its mj_makeData frees data after a plugin's -1
  EXPECT_TRUE(KnowsEngine(mjVERSION_HEADER));
  EXPECT_TRUE(KnowsEngine(4000007));
  EXPECT_FALSE(KnowsEngine(4001000));
  EXPECT_FALSE(KnowsEngine(3017000));
}

TEST(RefusedData, IsLeftToAnEngineThatIsNotKnown) {
  const Model m =
      MustCompile("<mujoco><worldbody><body><joint/><geom size='.1'/></body></worldbody></mujoco>");
  const Data d(mj_makeData(m.get()));
  const Warnings warnings;
  EXPECT_EQ(RefuseData(m.get(), d.get(), 0, "law is missing", 4001000), -1);
  EXPECT_EQ(Warnings::text(), "warmjoint.friction: law is missing");
  // as it was
  mj_step(m.get(), d.get());
  EXPECT_GT(d->time, 0);
}

}  // namespace
}  // namespace warmjoint
