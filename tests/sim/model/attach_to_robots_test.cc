// Friction onto every joint of real robots.
#include <gtest/gtest.h>
#include <warmjoint/attach.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "sim/model/load_model.h"
#include "tests/sim/model/light_friction.h"
#include "tests/support/shared_data.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

namespace fs = std::filesystem;
using test::FrictionJoints;
using test::LightFriction;

/// A robot file of the shared folder.
struct RobotFile {
  std::string name;
  fs::path path;
};
void PrintTo(const RobotFile& file, std::ostream* stream) { *stream << file.name; }

std::vector<RobotFile> RobotFiles() {
  std::vector<RobotFile> files;
  std::error_code absent;
  for (const auto& folder : fs::directory_iterator(test::SharedFolder() / "robots", absent)) {
    for (const auto& file : fs::directory_iterator(folder)) {
      const std::string extension = file.path().extension();
      if (extension != ".xml" && extension != ".urdf") continue;
      files.push_back({folder.path().filename(), file.path()});
    }
  }
  return files;
}

class AttachToRobot : public testing::TestWithParam<RobotFile> {
 protected:
  const fs::path& robot_ = GetParam().path;
  const ScratchDirectory folder_;
  const fs::path out_ = folder_.path() / "out.xml";

  /// Friction of at most 0.5 N.m, less on joints too light to stick with that at the model's step.
  std::vector<FrictionForJoint> EveryJoint(const mjModel* m) {
    std::vector<FrictionForJoint> all;
    for (int i = 0; i < m->njnt; ++i) {
      Friction friction = LightFriction();
      const double inertia = 1 / m->dof_invweight0[m->jnt_dofadr[i]];
      double& level = friction.parameters["coulomb"];
      level = std::min(level, 1e-3 * inertia / (m->opt.timestep * m->opt.timestep));
      all.push_back({mj_id2name(m, mjOBJ_JOINT, i), friction});
    }
    return all;
  }
};

TEST_P(AttachToRobot, EveryJointCarriesFrictionAndTheRestStays) {
  const LoadedModel before = LoadModel(robot_);
  AttachFriction(robot_, EveryJoint(before.model.get()), out_);
  const LoadedModel after = LoadModel(out_);
  const mjModel* m = after.model.get();
  EXPECT_EQ(FrictionJoints(m).size(), static_cast<size_t>(m->njnt));
  EXPECT_EQ(m->nplugin, 1) << "all joints share one instance";

  const DataPtr data(mj_makeData(m));
  for (int i = 0; i < 1000; ++i) mj_step(m, data.get());
  EXPECT_EQ(data->warning[mjWARN_BADQACC].number, 0);
  for (int i = 0; i < m->nv; ++i) EXPECT_TRUE(std::isfinite(data->qvel[i]));
  // one step of the bristle is bounded by the level, so the loss has warmed at least one joint
  double warmest = 0;
  for (int i = 0; i < m->na; ++i) warmest = std::max(warmest, std::abs(data->act[i]));
  EXPECT_GT(warmest, 0);

  // the rest of the model stays
  const mjModel *a = before.model.get(), *b = m;
  ASSERT_EQ(a->nbody, b->nbody);
  ASSERT_EQ(a->nv, b->nv);
  EXPECT_EQ(a->ngeom, b->ngeom);
  EXPECT_EQ(a->opt.timestep, b->opt.timestep);
  EXPECT_EQ(a->opt.integrator, b->opt.integrator);
  for (int i = 0; i < a->nbody; ++i) EXPECT_EQ(a->body_mass[i], b->body_mass[i]);
  for (int i = 0; i < 3 * a->nbody; ++i) EXPECT_EQ(a->body_ipos[i], b->body_ipos[i]);
  for (int i = 0; i < 3 * a->nbody; ++i) EXPECT_EQ(a->body_inertia[i], b->body_inertia[i]);
  for (int i = 0; i < 3 * a->njnt; ++i) EXPECT_EQ(a->jnt_axis[i], b->jnt_axis[i]);
  for (int i = 0; i < 2 * a->njnt; ++i) EXPECT_EQ(a->jnt_range[i], b->jnt_range[i]);
  for (int i = 0; i < a->nv; ++i) EXPECT_EQ(a->dof_armature[i], b->dof_armature[i]);
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(AttachToRobot);
INSTANTIATE_TEST_SUITE_P(SharedRobots, AttachToRobot, testing::ValuesIn(RobotFiles()),
                         [](const auto& robot) { return robot.param.name; });

}  // namespace
}  // namespace warmjoint
