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
    : friction_(ReadInstance(m, instance)) {
  friction_.SetTimestep(m->opt.timestep);
  for (int i = 0; i < m->nactuator; ++i) {
    if (m->actuator_plugin[i] != instance) continue;
    CheckActuator(m, i, friction_);
    joints_.push_back({i, m->jnt_dofadr[m->actuator_trnid[2 * i]], m->actuator_actadr[i],
                       m->actuator_outadr[i], 0});
  }
}

void FrictionInstance::Step(const mjModel* m, mjData* d) {
  const double h = m->opt.timestep;
  if (h != friction_.timestep()) friction_.SetTimestep(h);

  for (Joint& joint : joints_) {
    FrictionState now;
    const mjtNum* act = d->act + joint.state;
    for (const StateMember& member : friction_.state()) now.*member.value = *act++;
    const double inertia = EffectiveInertia(m, d, joint.dof);
    const FrictionStep step = friction_.Step(now, d->qvel[joint.dof], inertia);
    joint.force = step.force;

    mjtNum* rate = d->act_dot + joint.state;
    for (const StateMember& member : friction_.state()) {
      *rate++ = (step.next.*member.value - now.*member.value) / h;
    }
  }
}

void FrictionInstance::Apply(const mjModel* m, mjData* d) const {
  for (const Joint& joint : joints_) {
    const int group = m->actuator_group[joint.actuator];
    const bool disabled = group >= 0 && group < 31 && (m->opt.disableactuator >> group & 1);
    d->actuator_force[joint.output] = disabled ? 0 : -joint.force;
  }
}

}  // namespace warmjoint
