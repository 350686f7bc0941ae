// The passive form beside the actuator form: same motion, same carriage of states.
#include <gmock/gmock.h>

#include <cmath>

#include "models/foundation/atomic_file.h"
#include "tests/sim/plugin/two_forms.h"
#include "tests/support/folders.h"

namespace warmjoint {
namespace {

using namespace test;

double Difference(const Model& a, const Model& b, double seconds, double ambient) {
  const Data da(mj_makeData(a.get())), db(mj_makeData(b.get()));
  SetAmbient(a.get(), da.get(), Form::actuator, ambient);
  SetAmbient(b.get(), db.get(), Form::passive, ambient);
  double worst = 0;
  while (da->time < seconds) {
    DriveArm(a.get(), da.get(), 1);
    DriveArm(b.get(), db.get(), 1);
    for (int k = 0; k < kArmJoints; ++k) {
      worst = std::max(worst, std::abs(da->qpos[k] - db->qpos[k]));
    }
  }
  // warm, and the same states in the same order
  EXPECT_LT(da->act[1], -0.001);
  for (int k = 0; k < a->na; ++k) {
    EXPECT_NEAR(da->act[k], db->plugin_state[b->plugin_stateadr[0] + kFrictionReports + k], 1e-9);
  }
  return worst;
}

constexpr const char* kIntegrators[] = {"Euler", "implicit", "implicitfast", "discrete", "RK4"};

/// What the README says of a law under an integrator, after both forms of it have moved an arm alike.
std::string TryBothForms(const Friction& friction, const char* integrator) {
  const Model a = MustCompile(ArmXml(friction, Form::actuator, integrator));
  const Model b = MustCompile(ArmXml(friction, Form::passive, integrator));
  if (!a || !b) return "refused";
  // the forces are summed in another order; joints near a reversal amplify the last bit
  const double difference = Difference(a, b, 2, 10);
  EXPECT_LT(difference, 1e-11) << friction.law << " " << integrator;
  return difference < 1e-11 ? "both, alike" : "both, apart";
}

TEST(PluginForms, MoveAlikeWithEveryLawAndIntegratorAsTheReadmeSays) {
  std::string table = "| law |";
  for (const char* integrator : kIntegrators) table += fmt::format(" {} |", integrator);
  table += "\n|---|---|---|---|---|---|\n";
  for (const Friction& friction : FrictionsOfEveryLaw()) {
    table += fmt::format("| {} |", friction.law);
    for (const char* integrator : kIntegrators) {
      table += fmt::format(" {} |", TryBothForms(friction, integrator));
    }
    table += "\n";
  }
  const std::string readme = ReadWholeFile(SourceFolder() / "sim/plugin/README.md");
  EXPECT_THAT(readme, testing::HasSubstr(table)) << "write this table into sim/plugin/README.md:\n"
                                                 << table;
}

/// The largest difference within so many seconds between an arm and itself begun so many rad away.
double DifferenceOfStarts(const Model& m, double seconds, int joint, double away) {
  const Data a(mj_makeData(m.get())), b(mj_makeData(m.get()));
  b->qpos[joint] = away;
  double worst = 0;
  while (a->time < seconds) {
    DriveArm(m.get(), a.get(), 1);
    DriveArm(m.get(), b.get(), 1);
    for (int k = 0; k < kArmJoints; ++k) {
      worst = std::max(worst, std::abs(a->qpos[k] - b->qpos[k]));
    }
  }
  return worst;
}

/// The same of starts 1e-15 rad away at any joint, to either side.
double Sensitivity(const Model& m, double seconds) {
  double worst = 0;
  for (int joint = 0; joint < kArmJoints; ++joint) {
    for (const double away : {-1e-15, 1e-15}) {
      worst = std::max(worst, DifferenceOfStarts(m, seconds, joint, away));
    }
  }
  return worst;
}

TEST(PluginForms, MoveAlikeForAMinuteUnderGravityAsFarAsTheArmIsPredictable) {
  const Friction friction = FrictionsOfEveryLaw()[2];
  const Model a = MustCompile(ArmXml(friction, Form::actuator, "implicitfast"));
  const Model b = MustCompile(ArmXml(friction, Form::passive, "implicitfast"));
  EXPECT_LT(Difference(a, b, 20, 0), 1e-12);
  // the engine sums the forces in another order: some ten last bits, which the arm amplifies
  EXPECT_LT(Difference(a, b, 60, 0), 10 * Sensitivity(b, 60));
}

TEST(PluginPassive, LeavesTheRobotsOwnNumbersAsTheyWere) {
  const Model m = MustCompile(ArmXml(FrictionsOfEveryLaw()[0], Form::passive, "implicitfast"));
  EXPECT_EQ(m->nu, kArmJoints);
  EXPECT_EQ(m->na, 0);
  const Data d(mj_makeData(m.get()));
  DriveArm(m.get(), d.get(), 300);
  mj_forward(m.get(), d.get());
  // the motors alone are in qfrc_actuator
  for (int k = 0; k < kArmJoints; ++k) {
    EXPECT_EQ(d->qfrc_actuator[k], d->ctrl[k]);
    EXPECT_NE(d->qfrc_passive[k], -0.2 * d->qvel[k]);
  }
}

TEST(PluginPassive, WorksBesideALimitOfTheMotorsForce) {
  std::string xml = ArmXml(FrictionsOfEveryLaw()[0], Form::passive, "implicitfast");
  xml.insert(xml.find("axis="), R"(actuatorfrcrange="-1 1" )");
  const Model m = MustCompile(xml);
  const Data d(mj_makeData(m.get()));
  d->ctrl[0] = 5;
  mj_step(m.get(), d.get());
  EXPECT_EQ(d->qfrc_actuator[0], 1);
}

TEST(PluginPassive, RefusesJointsThatItCannotServe) {
  const Friction friction = FrictionsOfEveryLaw()[0];
  const auto error = [&](const std::string& from, const std::string& to) {
    std::string xml = ArmXml(friction, Form::passive, "Euler");
    const size_t at = xml.find(from);
    return Compile(xml.replace(at, from.size(), to)).error;
  };
  EXPECT_THAT(
      error("&quot;j2&quot;", "&quot;j3&quot;"),
      testing::StartsWith("Error: engine error: warmjoint.friction: plugin instance 'arm': joints "
                          "names 'j3', which the model lacks"));
  EXPECT_THAT(error("name=\"j1\" axis=\"1 0 0\"", "name=\"j1\" type=\"ball\""),
              testing::HasSubstr("joint 'j1' is neither hinge nor slide"));
  // and one that has friction from an actuator of its own
  EXPECT_THAT(error("<motor joint=\"j0\"/>",
                    R"(<plugin name="f" joint="j0" plugin="warmjoint.friction" actdim="2">
                       <config key="law" value="coulomb"/><config key="coulomb" value="1"/>
                       </plugin>)"),
              testing::HasSubstr("joint 'j0' has friction already, by actuator 'f'"));
}

TEST(PluginPassive, TravelsWithItsRobotUnderAPrefix) {
  for (const Form form : {Form::actuator, Form::passive}) {
    RegisterFrictionPlugin();
    const std::string xml = ArmXml(FrictionsOfEveryLaw()[2], form, "implicitfast");
    const Model alone = MustCompile(xml);
    char error[500] = "";
    const SpecPtr parent(mj_parseXMLString(
        R"(<mujoco><option timestep="0.001" integrator="implicitfast"><flag contact="disable"/>
           </option><worldbody/></mujoco>)",
        nullptr, error, sizeof(error)));
    std::vector<SpecPtr> children;
    for (const char* prefix : {"left/", "right/"}) {
      children.emplace_back(mj_parseXMLString(xml.c_str(), nullptr, error, sizeof(error)));
      mjsFrame* frame = mjs_addFrame(mjs_findBody(parent.get(), "world"), nullptr);
      ASSERT_TRUE(mjs_attach(frame->element, children.back()->element, prefix, ""));
    }
    const Model two(mj_compile(parent.get(), nullptr));
    ASSERT_TRUE(two) << mjs_getError(parent.get());
    ASSERT_EQ(two->nplugin, 2);
    const Data a(mj_makeData(alone.get())), b(mj_makeData(two.get()));
    a->qvel[0] = b->qvel[0] = b->qvel[kArmJoints] = 2;
    for (int i = 0; i < 500; ++i) {
      mj_step(alone.get(), a.get());
      mj_step(two.get(), b.get());
    }
    for (int k = 0; k < kArmJoints; ++k) {
      EXPECT_NEAR(b->qpos[k], a->qpos[k], 1e-12);
      EXPECT_NEAR(b->qpos[kArmJoints + k], a->qpos[k], 1e-12);
    }
  }
}

}  // namespace
}  // namespace warmjoint
