#include "sim/plugin/check_actuator.h"

#include "models/foundation/bad_input.h"
#include "sim/plugin/check_joint.h"

namespace warmjoint::inline sim {
namespace {

std::string NameOf(const mjModel* m, mjtObj type, const char* what, int id) {
  const char* name = mj_id2name(m, type, id);
  if (name && name[0]) return fmt::format("{} '{}'", what, name);
  return fmt::format("{} {}", what, id);
}

void CheckTransmission(const mjModel* m, int i, const Place& place) {
  // the engine must pass force on to the joint as it is
  if (m->actuator_trntype[i] != mjTRN_JOINT) {
    Refuse(place, "drives no joint; friction needs the attribute joint");
  }
  const int joint = m->actuator_trnid[2 * i];
  if (m->actuator_gear[6 * m->actuator_outadr[i]] != 1) {
    Refuse(place, "gear is {}; the transmission's gear must be 1 (the motor's is a config key)",
           m->actuator_gear[6 * m->actuator_outadr[i]]);
  }
  if (m->jnt_actfrclimited[joint]) {
    Refuse(place,
           "{} has actuatorfrcrange, which would clip friction too; limit the motor's "
           "forcerange instead, or take the passive form",
           JointName(m, joint));
  }
}

void CheckElement(const mjModel* m, int i, const JointFriction& friction, const Place& place) {
  // states as the friction needs them, and nothing that clips them
  const auto states = static_cast<size_t>(m->actuator_actadr[i] < 0 ? 0 : m->actuator_actnum[i]);
  if (m->actuator_dyntype[i] != mjDYN_NONE) Refuse(place, "dyntype must be none");
  if (states != friction.state().size()) {
    std::string names;
    for (const StateMember& member : friction.state()) {
      names += fmt::format("{}{}", names.empty() ? "" : ", ", member.name);
    }
    // the compiler takes a negative one as none
    const std::string given = states == 0 ? "not given, or below 1" : std::to_string(states);
    Refuse(place, "actdim is {}; it must be {} ({})", given, friction.state().size(), names);
  }
  if (m->actuator_actlimited[i]) {
    Refuse(place, "has an actrange, which would clip the states; leave it out");
  }
  if (m->actuator_forcelimited[i]) {
    Refuse(place, "has a forcerange, which would clip friction; leave it out");
  }
}

/// Two frictions on one joint would be one friction that is stiffer than the step can carry.
void RefuseSecond(const mjModel* m, int i, const Place& place) {
  // an earlier actuator of the same plugin on the same joint
  for (int other = 0; other < i; ++other) {
    const int plugin = m->actuator_plugin[other];
    if (plugin < 0 || m->plugin[plugin] != m->plugin[m->actuator_plugin[i]]) continue;
    if (m->actuator_trnid[2 * other] != m->actuator_trnid[2 * i]) continue;
    Refuse(place, "{} has friction already, by {}; remove one of the two",
           JointName(m, m->actuator_trnid[2 * i]), ActuatorName(m, other));
  }
}

}  // namespace

std::string ActuatorName(const mjModel* m, int actuator) {
  return NameOf(m, mjOBJ_ACTUATOR, "actuator", actuator);
}

std::string InstanceName(const mjModel* m, int instance) {
  // by the actuator that a user knows, else by its own name
  for (int i = 0; i < m->nactuator; ++i) {
    if (m->actuator_plugin[i] == instance) return ActuatorName(m, i);
  }
  return NameOf(m, mjOBJ_PLUGIN, "plugin instance", instance);
}

void CheckActuator(const mjModel* m, int actuator, const JointFriction& friction) {
  const Place place{ActuatorName(m, actuator)};
  CheckTransmission(m, actuator, place);
  CheckElement(m, actuator, friction, place);
  RefuseSecond(m, actuator, place);
}

}  // namespace warmjoint::inline sim
