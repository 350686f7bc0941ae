#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "models/robots/robot_folder.h"
#include "sim/model/load_model.h"
#include "tests/tools/cli/in_a_folder.h"

namespace warmjoint {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string FrictionFile(const std::string& robot) {
  return DataFolder() / "models" / "robots" / robot / "friction.json";
}

using AttachCommand = InAFolder;

TEST_F(AttachCommand, TellsWhatItChanged) {
  const std::string urdf = DataFolder() / "models" / "robots" / "pendulum" / "pendulum.urdf";
  const ProgramAnswer answer =
      Call({"attach", urdf, "--joint", "hinge=" + FrictionFile("pendulum"), "-o", "out.xml"});
  EXPECT_THAT(answer.err, AllOf(HasSubstr("notice: hinge"), HasSubstr("effort limit")));
  EXPECT_EQ(LoadModel(at("out.xml")).model->nactuator, 1) << "no motor comes unasked";
}

TEST_F(AttachCommand, WarnsOfAFrictionThatItsVerdictVoids) {
  const std::string plain = ReadWholeFile(FrictionFile("pendulum"));
  const nlohmann::json friction = nlohmann::json::parse(plain)["friction"];
  for (const auto& [status, warns] :
       {std::pair("inadequate_model", true), std::pair("ok", false)}) {
    WriteWholeFile(at("e.json"), nlohmann::json{{"status", status}, {"friction", friction}}.dump());
    const ProgramAnswer answer =
        Call({"attach", "pendulum", "--joint", "hinge=e.json", "-o", "out.xml"});
    EXPECT_EQ(answer.err.find("void") != std::string::npos, warns) << answer.err;
  }
}

TEST_F(AttachCommand, TakesPatternsFormAndChangesOfTheModel) {
  const std::string file = FrictionFile("yumi_like");
  const ProgramAnswer answer =
      Call({"attach", "yumi_like", "--joint", "joint_4=" + file, "--joint", "joint_[^4]=" + file,
            "--armature", "joint_.*=0.125", "--timestep", "0.00025", "--integrator", "implicitfast",
            "--sensors", "--numbers", "-o", "out.xml"});
  const LoadedModel loaded = LoadModel(at("out.xml"));
  const mjModel* m = loaded.model.get();
  EXPECT_EQ(m->opt.timestep, 0.00025);
  EXPECT_EQ(m->opt.integrator, mjINT_IMPLICITFAST);
  for (int i = 0; i < m->nv; ++i) EXPECT_EQ(m->dof_armature[i], 0.125);
  EXPECT_EQ(m->nsensor, m->njnt);
  EXPECT_GE(mj_name2id(m, mjOBJ_ACTUATOR, "joint_4_friction"), 0);
  EXPECT_GE(mj_name2id(m, mjOBJ_NUMERIC, "friction/coulomb_positive"), 0);
  EXPECT_THAT(answer.out, HasSubstr(fmt::format("on {} of its joints", m->njnt)));
}

TEST_F(AttachCommand, SaysThatARefusedEstimateHoldsNoFriction) {
  WriteWholeFile(at("e.json"), R"({"status": "inadequate_model", "friction": null})");
  EXPECT_THAT(Refusal({"attach", "pendulum", "--joint", "hinge=e.json", "-o", "out.xml"}),
              AllOf(HasSubstr("holds no friction"), HasSubstr("--force")));
}

using ListRobots = InAFolder;

TEST_F(ListRobots, GivesEachWithItsJointsAndGear) {
  const auto robots = Json({"list", "robots"});
  ASSERT_EQ(robots.size(), RobotNames().size());
  for (const auto& robot : robots) {
    EXPECT_FALSE(robot.at("description").get<std::string>().empty());
    EXPECT_FALSE(robot.at("joints").empty());
    EXPECT_GT(robot.at("friction").at("gear").get<double>(), 1);
  }
  EXPECT_THAT(Call({"list", "robots"}).out,
              AllOf(HasSubstr("yumi_like"), HasSubstr("joint_4"), HasSubstr("gear 100")));
}

}  // namespace
}  // namespace warmjoint
