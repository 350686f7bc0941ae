#include "sim/plugin/friction_instance.h"

#include <algorithm>
#include <cstdint>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/nearest_name.h"
#include "sim/plugin/check_actuator.h"

namespace warmjoint::inline sim {
namespace {

FrictionOfJoints ReadInstance(const mjModel* m, int instance) {
  const auto read = [&](const std::string& name) -> std::string {
    const char* text = mj_getPluginConfig(m, instance, name.c_str());
    return text ? text : "";
  };
  return ReadAttributes(read, {InstanceName(m, instance)});
}

/// The friction of an actuator's joint, which is taken out of those that have still to find theirs.
FrictionDescription FrictionOf(const mjModel* m, int actuator, const FrictionOfJoints& all,
                               std::vector<std::string>& waiting) {
  if (const auto every = all.find(""); every != all.end()) return every->second;
  const bool joint = m->actuator_trntype[actuator] == mjTRN_JOINT;
  const char* found = joint ? mj_id2name(m, mjOBJ_JOINT, m->actuator_trnid[2 * actuator]) : nullptr;
  const std::string name = found ? found : "";
  const auto friction = all.find(name);
  if (name.empty() || friction == all.end()) {
    std::vector<std::string> names;
    for (const auto& [known, unused] : all) names.push_back(known);
    Refuse({ActuatorName(m, actuator)}, "joints has no joint '{}'{}", Excerpt(name),
           Suggestion(name, names));
  }
  std::erase(waiting, name);
  return friction->second;
}

}  // namespace

FrictionInstance::FrictionInstance(const mjModel* m, int instance)
    : instance_(instance), timestep_(m->opt.timestep) {
  const FrictionOfJoints all = ReadInstance(m, instance);
  std::vector<std::string> waiting;
  for (const auto& [name, unused] : all) {
    if (!name.empty()) waiting.push_back(name);
  }
  for (int i = 0; i < m->nactuator; ++i) {
    if (m->actuator_plugin[i] == instance) Bind(m, i, FrictionOf(m, i, all, waiting));
  }
  if (joints_.empty() || waiting.empty()) return;
  Refuse({InstanceName(m, instance)},
         "joints names '{}', which no actuator of the instance drives; add one, or take it out",
         Excerpt(waiting.front()));
}

void FrictionInstance::Bind(const mjModel* m, int actuator, const FrictionDescription& friction) {
  Joint joint{.friction = JointFriction(friction)};
  joint.friction.SetTimestep(timestep_);
  CheckActuator(m, actuator, joint.friction);
  joint.needs_load = NeedsLoad(friction);
  joint.needs_ambient = friction.level_per_temperature != 0;
  if (joint.needs_ambient && m->actuator_ctrlnum[actuator] == 0) {
    Refuse({ActuatorName(m, actuator)},
           "has no control, which would be the ambient temperature's rise");
  }
  const int driven = m->actuator_trnid[2 * actuator];
  joint.actuator = actuator;
  joint.dof = m->jnt_dofadr[driven];
  joint.position = m->jnt_qposadr[driven];
  joint.state = m->actuator_actadr[actuator];
  joint.control = m->actuator_ctrladr[actuator];
  joint.output = m->actuator_outadr[actuator];
  joints_.push_back(std::move(joint));
}

JointMotion FrictionInstance::MotionOf(const mjModel* m, const mjData* d, const Joint& joint) {
  JointMotion motion;
  motion.position = d->qpos[joint.position];
  motion.velocity = d->qvel[joint.dof];
  motion.inertia = EffectiveInertia(m, d, joint.dof);
  if (joint.needs_load) motion.load = d->qfrc_bias[joint.dof];
  if (joint.needs_ambient) motion.ambient_rise = d->ctrl[joint.control];
  return motion;
}

void FrictionInstance::Step(const mjModel* m, mjData* d) {
  if (m->opt.integrator == mjINT_RK4) return LetGo(m, d);
  if (timestep_ != m->opt.timestep) {
    timestep_ = m->opt.timestep;
    for (Joint& joint : joints_) joint.friction.SetTimestep(timestep_);
  }
  const double rate = 1 / timestep_;
  for (Joint& joint : joints_) {
    FrictionState now;
    const mjtNum* act = d->act + joint.state;
    for (const StateMember& member : joint.friction.state()) now.*member.value = *act++;
    const FrictionStep step = joint.friction.Step(now, MotionOf(m, d, joint));
    joint.force = step.force;

    mjtNum* act_dot = d->act_dot + joint.state;
    for (const StateMember& member : joint.friction.state()) {
      *act_dot++ = (step.next.*member.value - now.*member.value) * rate;
    }
    if (step.feeds_itself) Report(m, d, joint);
  }
}

void FrictionInstance::Report(const mjModel* m, mjData* d, const Joint& joint) {
  // a double counts 52 joints; those beyond share the last place
  const auto place = std::min<ptrdiff_t>(&joint - joints_.data(), 51);
  const uint64_t bit = uint64_t{1} << place;
  mjtNum& reported = d->plugin_state[m->plugin_stateadr[instance_] + kReportsPush];
  const auto before = static_cast<uint64_t>(reported);
  if (before & bit) return;
  reported = static_cast<mjtNum>(before | bit);
  mju_warning(
      "%s: %s: at %g s friction would push the joint (its level is below 0 at %g rad/s or m/s); it "
      "is held at 0 from here on, and friction is outside its domain",
      kFrictionPlugin, ActuatorName(m, joint.actuator).c_str(), d->time, d->qvel[joint.dof]);
}

void FrictionInstance::LetGo(const mjModel* m, mjData* d) {
  for (Joint& joint : joints_) {
    joint.force = 0;
    std::fill_n(d->act_dot + joint.state, joint.friction.state().size(), 0.0);
  }
  mjtNum& reported = d->plugin_state[m->plugin_stateadr[instance_] + kReportsIntegrator];
  if (reported != 0) return;
  reported = 1;
  mju_warning(
      "%s: the integrator was set to RK4, whose inner steps would move the bristle four times: "
      "there is no friction until it is Euler, implicit, implicitfast or discrete again",
      kFrictionPlugin);
}

void FrictionInstance::Apply(const mjModel* m, mjData* d) const {
  for (const Joint& joint : joints_) {
    const int group = m->actuator_group[joint.actuator];
    const bool disabled = group >= 0 && group < 31 && (m->opt.disableactuator >> group & 1);
    d->actuator_force[joint.output] = disabled ? 0 : -joint.force;
  }
}

}  // namespace warmjoint::inline sim
