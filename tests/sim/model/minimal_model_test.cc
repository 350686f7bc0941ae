#include <gtest/gtest.h>

#include "models/foundation/atomic_file.h"
#include "sim/model/friction_actuator.h"
#include "sim/model/load_model.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

class MinimalModelOf : public testing::TestWithParam<JointKind> {};

TEST_P(MinimalModelOf, EitherKindRunsAndIsBraked) {
  Friction friction;
  friction.law = "asymmetric";
  friction.parameters = {{"viscous", 203.5}, {"coulomb_positive", 1}, {"coulomb_negative", 2}};
  friction.thermal = Thermal{-0.1, 60};
  friction.gear = 50;
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "friction.xml", MinimalModel(friction, GetParam()));
  const LoadedModel loaded = LoadModel(scratch.path() / "friction.xml");
  const mjModel* m = loaded.model.get();
  EXPECT_EQ(m->jnt_type[0], GetParam() == JointKind::linear ? mjJNT_SLIDE : mjJNT_HINGE);

  const DataPtr data(mj_makeData(m));
  data->qvel[0] = -1;
  mj_step(m, data.get());
  // F = kv v - kc- at v = -1, by the law's own numbers
  EXPECT_DOUBLE_EQ(data->actuator_force[0], 203.5 + 2);
  EXPECT_GT(data->qvel[0], -1);
}

INSTANTIATE_TEST_SUITE_P(Joint, MinimalModelOf,
                         testing::Values(JointKind::rotary, JointKind::linear));

}  // namespace
}  // namespace warmjoint
