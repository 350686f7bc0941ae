// A driven arm of three joints, with the same friction in the actuator and in the passive form.
#pragma once

#include <mujoco/mjbatch.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "models/foundation/xml_tags.h"
#include "models/friction/friction_json.h"
#include "models/friction/joint_friction.h"
#include "sim/model/friction_actuator.h"
#include "sim/plugin/friction_instance.h"
#include "tests/sim/plugin/friction_models.h"

namespace warmjoint::test {

inline constexpr int kArmJoints = 3;

enum class Form { actuator, passive };

/// Frictions of every law, with loads, ambient, two stages and maps among them; warm within
/// seconds.
inline std::vector<Friction> FrictionsOfEveryLaw() {
  std::vector<Friction> all;
  const auto add = [&](const char* law, const std::map<std::string, double>& parameters) {
    all.push_back({law, parameters, Thermal{-0.02, 3}});
    FillDefaults(all.back());
    return &all.back();
  };
  all.reserve(Laws().size());
  add("coulomb", {{"coulomb", 0.8}});
  add("viscous_coulomb", {{"viscous", 0.1}, {"coulomb", 0.8}})->level_per_temperature = -0.02;
  auto* mapped =
      add("asymmetric", {{"viscous", 0.1}, {"coulomb_positive", 0.7}, {"coulomb_negative", 0.9}});
  FrictionMap map;
  map.axes = {{MapQuantity::position, EvenAxis(-1, 1, 5)}, {MapQuantity::load, EvenAxis(-3, 3, 3)}};
  map.weights.assign(15, 0.05);
  map.factor = MapFactor::direction;
  mapped->maps = {map};
  add("stribeck", {{"viscous", 0.1}, {"coulomb", 0.6}, {"static", 0.9}, {"stribeck_velocity", 0.1}})
      ->load_gain = 0.05;
  add("stiction", {{"viscous", 0.1}, {"coulomb", 0.6}, {"static", 0.9}})->second_thermal =
      Thermal{-0.01, 0.5};
  add("dahl", {{"coulomb", 0.8}, {"bristle_stiffness", 500}});
  add("lugre", {{"viscous", 0.1},
                {"coulomb", 0.6},
                {"static", 0.9},
                {"stribeck_velocity", 0.1},
                {"bristle_stiffness", 500},
                {"bristle_damping", 2}});
  add("asymmetric_stribeck", {{"viscous", 0.1},
                              {"coulomb_positive", 0.6},
                              {"coulomb_negative", 0.8},
                              {"static_rise", 0.3},
                              {"stribeck_velocity", 0.1}});
  add("asymmetric_lugre", {{"viscous", 0.1},
                           {"coulomb_positive", 0.6},
                           {"coulomb_negative", 0.8},
                           {"static_rise", 0.3},
                           {"stribeck_velocity", 0.1},
                           {"bristle_stiffness", 500},
                           {"bristle_damping", 2}});
  return all;
}

/// The arm's MJCF with that friction on all three joints, and a motor on each.
inline std::string ArmXml(const Friction& friction, Form form, const std::string& integrator,
                          const std::string& more = "") {
  nlohmann::json joints;
  std::string bodies, motors, frictions, ends;
  for (int i = 0; i < kArmJoints; ++i) {
    joints[fmt::format("j{}", i)] = FrictionToTree(friction);
    bodies += fmt::format(
        R"(<body pos="0 0 {}"><joint name="j{}" axis="{}" armature="0.05" damping="0.2"/>
           <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.03" mass="{}"/>)",
        i == 0 ? 0 : -0.3, i, i == 1 ? "1 0 0" : "0 1 0", 2 - 0.5 * i);
    if (i == 0) bodies += R"(<plugin plugin="warmjoint.friction" instance="arm"/>)";
    ends += "</body>";
    motors += fmt::format(R"(<motor joint="j{}"/>)", i);
    if (form == Form::passive) continue;
    frictions += fmt::format(
        R"(<plugin joint="j{}" plugin="warmjoint.friction" instance="arm" actdim="{}"/>)", i,
        StateOf(friction).size());
  }
  return fmt::format(R"(
<mujoco>
  <extension><plugin plugin="warmjoint.friction"><instance name="arm">
    <config key="instance" value="arm"/><config key="joints" value="{}"/>{}
  </instance></plugin></extension>
  <option timestep="0.001" integrator="{}"><flag contact="disable"/></option>
  <worldbody>{}{}</worldbody>
  <actuator>{}{}</actuator>
</mujoco>)",
                     EscapeXml(joints.dump()), more, integrator, bodies, ends, motors, frictions);
}

/// The same, whose friction has the sensor "s". object: attributes of an object that it names, or none.
inline std::string SensedArmXml(const Friction& friction, Form form,
                                const std::string& object = "") {
  std::string xml = ArmXml(friction, form, "implicitfast");
  return xml.insert(xml.rfind("</mujoco>"),
                    fmt::format(R"(<sensor><plugin name="s" plugin="warmjoint.friction"
                                     instance="arm" {}/></sensor>)",
                                object));
}

/// Drives the arm so that its joints slide, turn and stick.
inline void DriveArm(const mjModel* m, mjData* d, int steps) {
  for (int i = 0; i < steps; ++i) {
    for (int k = 0; k < kArmJoints; ++k) {
      d->ctrl[k] = (6 - 2 * k) * std::sin((2 + 1.5 * k) * d->time);
    }
    mj_step(m, d);
  }
}

/// Sets the ambient's rise of all joints, K.
inline void SetAmbient(const mjModel* m, mjData* d, Form form, double rise) {
  if (form == Form::actuator) {
    std::fill_n(d->ctrl + kArmJoints, kArmJoints, rise);
  } else {
    d->plugin_state[m->plugin_stateadr[0] + kAmbientRise] = rise;
  }
}

/// The states of the joints, of one joint after the other.
inline mjtNum* StatesOf(const mjModel* m, mjData* d) {
  return m->na > 0 ? d->act : d->plugin_state + m->plugin_stateadr[0] + kFrictionReports;
}

inline std::vector<mjtNum> FullState(const mjModel* m, const mjData* d) {
  std::vector<mjtNum> state(mj_stateSize(m, mjSTATE_FULLPHYSICS));
  mj_getState(m, d, state.data(), mjSTATE_FULLPHYSICS);
  return state;
}

struct DeleteBatch {
  void operator()(mjBatch* batch) const { mjb_deleteBatch(batch); }
};
using Batch = std::unique_ptr<mjBatch, DeleteBatch>;

inline Batch MakeBatch(const mjModel* m, int worlds, int threads) {
  mjBatchConfig config;
  mjb_defaultConfig(&config);
  config.nthread = threads;
  char error[500] = "";
  Batch batch(mjb_makeBatch(m, worlds, &config, error, sizeof(error)));
  EXPECT_TRUE(batch) << error;
  return batch;
}

/// Steps all worlds from a reset under the same controls, one set for each step.
inline void RollOut(mjBatch* batch, int worlds, int steps, const std::vector<mjtNum>& controls) {
  ASSERT_EQ(mjb_reset(batch, nullptr, worlds, nullptr, mjSTAGE_NONE), 0);
  std::vector<mjtNum> all;
  for (int i = 0; i < worlds; ++i) all.insert(all.end(), controls.begin(), controls.end());
  ASSERT_EQ(mjb_rollout(batch, nullptr, worlds, steps, all.data(), mjSTATE_CTRL, nullptr, 0), 0);
}

}  // namespace warmjoint::test
