#include "sim/plugin/friction_instance.h"

#include "models/foundation/bad_input.h"
#include "sim/plugin/attributes.h"
#include "sim/plugin/check_actuator.h"

namespace warmjoint {
namespace {

FrictionDescription ReadInstance(const mjModel* m, int instance) {
  const auto read = [&](const std::string& name) -> std::string {
    const char* text = mj_getPluginConfig(m, instance, name.c_str());
    return text ? text : "";
  };
  return ReadAttributes(read, {InstanceName(m, instance)});
}

}  // namespace

FrictionInstance::FrictionInstance(const mjModel* m, int instance)
    : FrictionInstance(m, instance, ReadInstance(m, instance)) {}

FrictionInstance::FrictionInstance(const mjModel* m, int instance,
                                   const FrictionDescription& friction)
    : instance_(instance),
      friction_(friction),
      needs_load_(NeedsLoad(friction)),
      needs_ambient_(friction.level_per_temperature != 0) {
  friction_.SetTimestep(m->opt.timestep);
  for (int i = 0; i < m->nactuator; ++i) {
    if (m->actuator_plugin[i] != instance) continue;
    CheckActuator(m, i, friction_);
    if (needs_ambient_ && m->actuator_ctrlnum[i] == 0) {
      Refuse({ActuatorName(m, i)}, "has no control, which would be the ambient temperature's rise");
    }
    const int joint = m->actuator_trnid[2 * i];
    joints_.push_back({i, m->jnt_dofadr[joint], m->jnt_qposadr[joint], m->actuator_actadr[i],
                       m->actuator_ctrladr[i], m->actuator_outadr[i], 0});
  }
}

JointMotion FrictionInstance::MotionOf(const mjModel* m, const mjData* d,
                                       const Joint& joint) const {
  JointMotion motion;
  motion.position = d->qpos[joint.position];
  motion.velocity = d->qvel[joint.dof];
  motion.inertia = EffectiveInertia(m, d, joint.dof);
  if (needs_load_) motion.load = d->qfrc_bias[joint.dof];
  if (needs_ambient_) motion.ambient_rise = d->ctrl[joint.control];
  return motion;
}

void FrictionInstance::Step(const mjModel* m, mjData* d) {
  const double h = m->opt.timestep;
  if (h != friction_.timestep()) friction_.SetTimestep(h);

  for (Joint& joint : joints_) {
    FrictionState now;
    const mjtNum* act = d->act + joint.state;
    for (const StateMember& member : friction_.state()) now.*member.value = *act++;
    const FrictionStep step = friction_.Step(now, MotionOf(m, d, joint));
    joint.force = step.force;

    mjtNum* rate = d->act_dot + joint.state;
    for (const StateMember& member : friction_.state()) {
      *rate++ = (step.next.*member.value - now.*member.value) / h;
    }
    if (step.feeds_itself) Report(m, d, joint);
  }
}

void FrictionInstance::Report(const mjModel* m, mjData* d, const Joint& joint) {
  mjtNum& reported = d->plugin_state[m->plugin_stateadr[instance_]];
  if (reported != 0) return;
  reported = 1;
  mju_warning(
      "%s: %s: at %g s friction would push the joint (its level is below 0 at %g rad/s or m/s); it "
      "is held at 0 from here on, and friction is outside its domain",
      kFrictionPlugin, ActuatorName(m, joint.actuator).c_str(), d->time, d->qvel[joint.dof]);
}

void FrictionInstance::Apply(const mjModel* m, mjData* d) const {
  for (const Joint& joint : joints_) {
    const int group = m->actuator_group[joint.actuator];
    const bool disabled = group >= 0 && group < 31 && (m->opt.disableactuator >> group & 1);
    d->actuator_force[joint.output] = disabled ? 0 : -joint.force;
  }
}

}  // namespace warmjoint
