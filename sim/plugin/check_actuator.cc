#include "sim/plugin/check_actuator.h"

#include "models/foundation/bad_input.h"
#include "sim/plugin/friction_instance.h"

namespace warmjoint {
namespace {

std::string NameOf(const mjModel* m, mjtObj type, const char* what, int id) {
  const char* name = mj_id2name(m, type, id);
  if (name && name[0]) return fmt::format("{} '{}'", what, name);
  return fmt::format("{} {}", what, id);
}

void CheckTransmission(const mjModel* m, int i, const Place& place) {
  if (m->actuator_trntype[i] != mjTRN_JOINT) {
    Refuse(place, "drives no joint; friction needs the attribute joint");
  }
  const int joint = m->actuator_trnid[2 * i];
  const std::string name = NameOf(m, mjOBJ_JOINT, "joint", joint);
  if (m->jnt_type[joint] != mjJNT_HINGE && m->jnt_type[joint] != mjJNT_SLIDE) {
    Refuse(place, "{} is neither hinge nor slide; friction acts on these alone", name);
  }
  if (m->actuator_gear[6 * m->actuator_outadr[i]] != 1) {
    Refuse(place, "gear is {}; the transmission's gear must be 1 (the motor's is a config key)",
           m->actuator_gear[6 * m->actuator_outadr[i]]);
  }
  if (m->jnt_actfrclimited[joint]) {
    Refuse(place,
           "{} has actuatorfrcrange, which would clip friction too; limit the motor's "
           "forcerange instead",
           name);
  }
}

void CheckElement(const mjModel* m, int i, const Place& place) {
  const int states = m->actuator_actadr[i] < 0 ? 0 : m->actuator_actnum[i];
  if (m->actuator_dyntype[i] != mjDYN_NONE) Refuse(place, "dyntype must be none");
  if (states != kFrictionStates) {
    Refuse(place, "actdim is {}; it must be {} (bristle load, energy)", states, kFrictionStates);
  }
  if (m->actuator_forcelimited[i]) {
    Refuse(place, "has a forcerange, which would clip friction; leave it out");
  }
}

void CheckStep(const mjModel* m, int i, const JointFriction& friction, const Place& place) {
  if (m->opt.integrator == mjINT_RK4) {
    Refuse(place,
           "integrator is RK4, whose inner steps would move the bristle four times; use "
           "Euler, implicit, implicitfast or discrete");
  }

  // an explicit slope of force over speed oscillates above M/h and diverges above 2 M/h
  const double inertia = EffectiveInertia(m, m->jnt_dofadr[m->actuator_trnid[2 * i]]);
  const double h = m->opt.timestep;
  const double needed = friction.viscous() * h;
  if (inertia > 0 && needed > inertia) {
    Refuse(place,
           "viscous is {} on an effective inertia of {:.3g} at timestep {}; the step would "
           "be unstable: add an armature of {:.3g} or take a timestep of at most {:.3g} s",
           friction.viscous(), inertia, h, needed - inertia, inertia / friction.viscous());
  }
}

}  // namespace

std::string ActuatorName(const mjModel* m, int actuator) {
  return NameOf(m, mjOBJ_ACTUATOR, "actuator", actuator);
}

std::string InstanceName(const mjModel* m, int instance) {
  for (int i = 0; i < m->nactuator; ++i) {
    if (m->actuator_plugin[i] == instance) return ActuatorName(m, i);
  }
  return NameOf(m, mjOBJ_PLUGIN, "plugin instance", instance);
}

void CheckActuator(const mjModel* m, int actuator, const JointFriction& friction) {
  const Place place{ActuatorName(m, actuator)};
  CheckTransmission(m, actuator, place);
  CheckElement(m, actuator, place);
  CheckStep(m, actuator, friction, place);
}

}  // namespace warmjoint
