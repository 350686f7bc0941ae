#include "sim/plugin/plugin_instances.h"

#include <algorithm>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/nearest_name.h"
#include "sim/plugin/check_actuator.h"
#include "sim/plugin/check_joint.h"
#include "sim/plugin/joint_names.h"

namespace warmjoint::inline sim {
namespace {

std::vector<std::string> JointsIn(const mjModel* m) {
  std::vector<std::string> names;
  for (int i = 0; i < m->njnt; ++i) names.push_back(NameIn(m, mjOBJ_JOINT, i));
  return names;
}

}  // namespace

std::string NameIn(const mjModel* m, mjtObj type, int id) {
  const char* name = mj_id2name(m, type, id);
  return name ? name : "";
}

std::vector<std::string> JointsOf(const PreparedInstance& prepared) {
  std::vector<std::string> names;
  for (const auto& [name, unused] : prepared.joints) names.push_back(name);
  return names;
}

bool DrivenByActuators(const mjModel* m, int instance) {
  const int *begin = m->actuator_plugin, *end = begin + m->nactuator;
  return std::find(begin, end, instance) != end;
}

std::vector<PassiveJoint> FindPassive(const mjModel* m, int instance,
                                      const PreparedInstance& prepared) {
  const Place place{InstanceName(m, instance)};
  if (prepared.joints.contains("")) {
    Refuse(place,
           "no actuator refers to it; one that acts by itself needs the attribute joints, which "
           "names them");
  }
  // names as the model has them, whatever prefix it was given
  const std::vector<std::string> all = JointsIn(m), named = JointsOf(prepared);
  const std::set<std::string> known(all.begin(), all.end());
  const InstanceNames names{prepared.written_name, NameIn(m, mjOBJ_PLUGIN, instance)};
  const auto exists = [&](const std::string& name) { return known.contains(name); };
  const Renaming renaming = FindRenaming(names, named, {}, exists);

  std::vector<PassiveJoint> joints;
  for (const auto& [name, joint] : prepared.joints) {
    const std::string actual = renaming(name);
    const int id = mj_name2id(m, mjOBJ_JOINT, actual.c_str());
    if (id < 0) {
      Refuse(place, "joints names '{}', which the model lacks{}", Excerpt(name),
             Suggestion(name, all));
    }
    joints.push_back({id, &joint});
  }

  // in the order of the model
  const auto before = [](const PassiveJoint& a, const PassiveJoint& b) {
    return a.joint < b.joint;
  };
  std::sort(joints.begin(), joints.end(), before);
  return joints;
}

int PassiveStates(const mjModel* m, int instance) {
  const auto prepared = PrepareInstance(m, instance, {InstanceName(m, instance)});
  size_t states = 0;
  for (const PassiveJoint& joint : FindPassive(m, instance, *prepared)) {
    states += joint.prepared->friction.state().size();
  }
  return static_cast<int>(states);
}

std::string FrictionOn(const mjModel* m, int joint, int plugin, int end) {
  // actuators of the same plugin
  for (int i = 0; i < m->nactuator; ++i) {
    const int instance = m->actuator_plugin[i];
    const bool ours = instance >= 0 && m->plugin[instance] == plugin;
    if (ours && m->actuator_trnid[2 * i] == joint) return ActuatorName(m, i);
  }

  // instances that act by themselves, of those before `end`
  for (int other = 0; other < end; ++other) {
    if (m->plugin[other] != plugin || DrivenByActuators(m, other)) continue;
    const auto prepared = PrepareInstance(m, other, {InstanceName(m, other)});
    for (const PassiveJoint& taken : FindPassive(m, other, *prepared)) {
      if (taken.joint == joint) return InstanceName(m, other);
    }
  }
  return {};
}

void RefuseSecond(const mjModel* m, int instance, int joint) {
  const std::string other = FrictionOn(m, joint, m->plugin[instance], instance);
  if (other.empty()) return;
  Refuse({InstanceName(m, instance)}, "{} has friction already, by {}; remove one of the two",
         JointName(m, joint), other);
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
      const auto prepared = PrepareInstance(m, other, {InstanceName(m, other)});
      for (const PassiveJoint& joint : FindPassive(m, other, *prepared)) add(joint.joint, other);
    } catch (const BadInput&) {
      // it refuses the model itself
    }
  }
  return others;
}

}  // namespace warmjoint::inline sim
