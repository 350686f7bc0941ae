#include "sim/plugin/plugin_instances.h"

#include <algorithm>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"

namespace warmjoint {
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
  if (m->actuator_forcelimited[i]) {
    Refuse(place, "has a forcerange, which would clip friction; leave it out");
  }
}

/// Two frictions on one joint would be one friction that is stiffer than the step can carry.
void RefuseSecond(const mjModel* m, int joint, const std::string& other, const Place& place) {
  if (other.empty()) return;
  Refuse(place, "{} has friction already, by {}; remove one of the two", JointName(m, joint),
         other);
}

/// What MuJoCo put around every name of an attached model.
struct Renaming {
  std::string prefix;
  std::string suffix;

  std::string operator()(const std::string& name) const { return prefix + name + suffix; }
};

/// Around the written name in the actual one, none, beginnings of the actual name, the longest first, and
/// those of driven joints.
std::vector<Renaming> Candidates(const std::string& written, const std::string& actual,
                                 const std::string& first_joint,
                                 const std::vector<std::string>& driven) {
  std::vector<Renaming> candidates;
  for (size_t at = written.empty() ? std::string::npos : actual.find(written);
       at != std::string::npos; at = actual.find(written, at + 1)) {
    candidates.push_back({actual.substr(0, at), actual.substr(at + written.size())});
  }
  candidates.emplace_back();
  for (size_t n = actual.size(); n > 0; --n) candidates.push_back({actual.substr(0, n), ""});
  for (const std::string& joint : driven) {
    if (!joint.ends_with(first_joint)) continue;
    candidates.push_back({joint.substr(0, joint.size() - first_joint.size()), ""});
  }
  return candidates;
}

/// The instance's joints by their names in the model, among `all`. driven: those of its actuators.
std::map<std::string, const PreparedJoint*> NameJoints(const mjModel* m, int instance,
                                                       const PreparedInstance& prepared,
                                                       const std::vector<std::string>& all,
                                                       const std::vector<std::string>& driven) {
  // the first renaming by which every joint is there, else the names as they are
  const std::set<std::string> known(all.begin(), all.end());
  Renaming renaming;
  for (const Renaming& candidate :
       Candidates(prepared.written_name, NameIn(m, mjOBJ_PLUGIN, instance),
                  prepared.joints.begin()->first, driven)) {
    const auto fits = [&](const auto& joint) { return known.contains(candidate(joint.first)); };
    if (!std::ranges::all_of(prepared.joints, fits)) continue;
    renaming = candidate;
    break;
  }
  std::map<std::string, const PreparedJoint*> joints;
  for (const auto& [name, joint] : prepared.joints) joints[renaming(name)] = &joint;
  return joints;
}

using Prepared = std::shared_ptr<const PreparedInstance>;

std::vector<ActingJoint> FindDriven(const mjModel* m, int instance, const Prepared& prepared) {
  // the joint of each actuator
  std::vector<ActingJoint> found;
  std::vector<std::string> driven;
  for (int i = 0; i < m->nactuator; ++i) {
    if (m->actuator_plugin[i] != instance) continue;
    const int joint = m->actuator_trntype[i] == mjTRN_JOINT ? m->actuator_trnid[2 * i] : -1;
    found.push_back({joint, i, nullptr});
    driven.push_back(joint < 0 ? "" : NameIn(m, mjOBJ_JOINT, joint));
  }

  // one friction may be meant for every joint; else each joint has its own
  if (const auto every = prepared->joints.find(""); every != prepared->joints.end()) {
    for (ActingJoint& joint : found) joint.prepared = {prepared, &every->second};
    return found;
  }
  const auto named = NameJoints(m, instance, *prepared, driven, driven);
  for (size_t k = 0; k < found.size(); ++k) {
    const auto own = named.find(driven[k]);
    if (driven[k].empty() || own == named.end()) {
      std::vector<std::string> names;
      for (const auto& [name, unused] : prepared->joints) names.push_back(name);
      Refuse({ActuatorName(m, found[k].actuator)}, "joints has no joint '{}'{}", Excerpt(driven[k]),
             Suggestion(driven[k], names));
    }
    found[k].prepared = {prepared, own->second};
  }
  for (const auto& [name, unused] : named) {
    if (std::ranges::find(driven, name) != driven.end()) continue;
    Refuse({InstanceName(m, instance)},
           "joints names '{}', which no actuator of the instance drives; add one, or take it out",
           Excerpt(name));
  }
  return found;
}

std::vector<ActingJoint> FindPassive(const mjModel* m, int instance, const Prepared& prepared) {
  const Place place{InstanceName(m, instance)};
  if (prepared->joints.contains("")) {
    Refuse(place,
           "no actuator refers to it; one that acts by itself needs the attribute joints, which "
           "names them");
  }
  // names as the model has them, whatever prefix it was given
  std::vector<std::string> all;
  for (int i = 0; i < m->njnt; ++i) all.push_back(NameIn(m, mjOBJ_JOINT, i));
  std::vector<ActingJoint> joints;
  for (const auto& [name, prepared_joint] : NameJoints(m, instance, *prepared, all, {})) {
    const int id = mj_name2id(m, mjOBJ_JOINT, name.c_str());
    if (id < 0) {
      Refuse(place, "joints names '{}', which the model lacks{}", Excerpt(name),
             Suggestion(name, all));
    }
    joints.push_back({id, -1, {prepared, prepared_joint}});
  }
  std::ranges::sort(joints, {}, &ActingJoint::joint);
  return joints;
}

}  // namespace

std::string JointName(const mjModel* m, int joint) {
  return NameOf(m, mjOBJ_JOINT, "joint", joint);
}

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
  const int joint = m->actuator_trnid[2 * actuator];
  const int plugin = m->plugin[m->actuator_plugin[actuator]];
  RefuseSecond(m, joint, FrictionOn(m, joint, plugin, actuator, 0), place);
}

void CheckAlone(const mjModel* m, int instance, int joint) {
  const auto actuators = static_cast<int>(m->nactuator);
  RefuseSecond(m, joint, FrictionOn(m, joint, m->plugin[instance], actuators, instance),
               {InstanceName(m, instance)});
}

std::string NameIn(const mjModel* m, mjtObj type, int id) {
  const char* name = mj_id2name(m, type, id);
  return name ? name : "";
}

bool DrivenByActuators(const mjModel* m, int instance) {
  const int *begin = m->actuator_plugin, *end = begin + m->nactuator;
  return std::find(begin, end, instance) != end;
}

std::vector<ActingJoint> FindJoints(const mjModel* m, int instance) {
  const Prepared prepared = PrepareInstance(m, instance);
  return DrivenByActuators(m, instance) ? FindDriven(m, instance, prepared)
                                        : FindPassive(m, instance, prepared);
}

std::string FrictionOn(const mjModel* m, int joint, int plugin, int actuators, int instances) {
  // actuators of the same plugin
  for (int i = 0; i < actuators; ++i) {
    const int instance = m->actuator_plugin[i];
    const bool ours = instance >= 0 && m->plugin[instance] == plugin;
    if (ours && m->actuator_trnid[2 * i] == joint) return ActuatorName(m, i);
  }

  // instances that act by themselves
  for (int other = 0; other < instances; ++other) {
    if (m->plugin[other] != plugin || DrivenByActuators(m, other)) continue;
    for (const ActingJoint& taken : FindJoints(m, other)) {
      if (taken.joint == joint) return InstanceName(m, other);
    }
  }
  return {};
}

OtherInstances FindOthers(const mjModel* m, int instance) {
  OtherInstances others;
  const auto add = [&](int joint, int other) {
    others[m->dof_treeid[m->jnt_dofadr[joint]]].insert(other);
  };
  // through actuators, and by themselves
  for (int i = 0; i < m->nactuator; ++i) {
    const int other = m->actuator_plugin[i];
    const bool friction =
        other >= 0 && other != instance && m->plugin[other] == m->plugin[instance];
    if (friction && m->actuator_trntype[i] == mjTRN_JOINT) add(m->actuator_trnid[2 * i], other);
  }
  for (int other = 0; other < m->nplugin; ++other) {
    if (other == instance || m->plugin[other] != m->plugin[instance]) continue;
    if (DrivenByActuators(m, other)) continue;
    try {
      for (const ActingJoint& joint : FindJoints(m, other)) add(joint.joint, other);
    } catch (const BadInput&) {
      // it refuses the model itself
    }
  }
  return others;
}

}  // namespace warmjoint
