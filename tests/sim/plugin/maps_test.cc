// Maps, load and friction files in the engine.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "models/foundation/atomic_file.h"
#include "models/friction/friction_json.h"
#include "sim/model/friction_actuator.h"
#include "sim/model/load_model.h"
#include "tests/sim/plugin/friction_models.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

using namespace test;

/// Law (3) with heat, a ripple over the motor's angle, and a level that grows with the load.
Friction Rippled() {
  Friction friction{"asymmetric",
                    {{"viscous", 0.4}, {"coulomb_positive", 3}, {"coulomb_negative", 4}},
                    Thermal{-0.3, 50},
                    0,
                    20};
  friction.second_thermal = Thermal{-0.1, 5};
  friction.load_gain = 0.1;
  FrictionMap map{{{MapQuantity::motor_position, CircleAxis(2 * std::numbers::pi, 12)},
                   {MapQuantity::velocity, SpeedAxis(0.2, 2, 2)}},
                  KernelKind::normalised,
                  {}};
  for (size_t i = 0; i < map.size(); ++i) {
    map.weights.push_back(std::sin(static_cast<double>(i)));
  }
  friction.maps = {map};
  CheckFriction(friction, {"test"});
  return friction;
}

std::string ActuatorXml(const std::string& configs) {
  return fmt::format(
      R"(<actuator><plugin name="f" joint="hinge" plugin="warmjoint.friction" actdim="3">{}</plugin></actuator>)",
      configs);
}

/// The sections that `attach` writes.
std::string InlineXml(const Friction& friction) {
  const std::string sections = FrictionSections({"hinge", friction});
  return sections.substr(sections.find("<actuator>"));
}

constexpr char kSwing[] = R"(timestep="0.001" gravity="0 0 -9.81")";

/// Where the link is after it was driven to and fro, and its states.
std::vector<double> Swing(const mjModel* m) {
  const Data d(mj_makeData(m));
  while (d->time < 3) {
    d->qfrc_applied[0] = d->qfrc_bias[0] + 15 * std::sin(5 * d->time);
    mj_step(m, d.get());
  }
  return {d->qpos[0], d->qvel[0], d->act[0], d->act[1], d->act[2]};
}

TEST(PluginMaps, AreTheSameInlineAndFromAFileInAFolderOrBesideTheModel) {
  const ScratchDirectory folder;
  const std::string path = folder.path() / "rippled.json";
  WriteWholeFile(path, FrictionToTree(Rippled()).dump());
  const std::vector<double> state = Swing(MustCompile(LinkXml(InlineXml(Rippled()), kSwing)).get());
  EXPECT_LT(state[3], -0.01) << "should be warm";

  const std::string whole = fmt::format(R"(<config key="file" value="{}"/>)", path);
  EXPECT_EQ(Swing(MustCompile(LinkXml(ActuatorXml(whole), kSwing)).get()), state);
  const std::string name = R"(<config key="file" value="rippled.json"/>)";
  const std::string in_folder =
      name + fmt::format(R"(<config key="folder" value="{}"/>)", folder.path().string());
  EXPECT_EQ(Swing(MustCompile(LinkXml(ActuatorXml(in_folder), kSwing)).get()), state);
  // a model that this program loads may name a file beside it
  WriteWholeFile(folder.path() / "link.xml", LinkXml(ActuatorXml(name), kSwing));
  EXPECT_EQ(Swing(LoadModel(folder.path() / "link.xml").model.get()), state);
}

TEST(PluginLoad, RaisesTheLevelByTheLoadThatTheJointTransmits) {
  // 1 kg at 0.5 m: 4.905 N.m; level 4 + 0.25 * 4.905 = 5.23 holds it, 4 alone would not
  for (const bool holds : {true, false}) {
    const Config config{
        {"law", "coulomb"}, {"coulomb", "4"}, {"load_gain", holds ? "0.25" : "0.1"}};
    const Model m = MustCompile(LinkXml(FrictionSection(config), kSwing));
    const Data d(mj_makeData(m.get()));
    while (d->time < 2) mj_step(m.get(), d.get());
    EXPECT_EQ(std::abs(d->qpos[0]) < 0.01, holds) << d->qpos[0];
  }
}

}  // namespace
}  // namespace warmjoint
