#include "sim/plugin/bound_joints.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "sim/plugin/plugin_instances.h"
#include "sim/plugin/stability.h"

namespace warmjoint {
namespace {

/// others: the other instances on each kinematic tree.
BoundJoint BindJoint(const mjModel* m, int joint, const PreparedJoint& prepared,
                     const OtherInstances& others) {
  // where the engine keeps its numbers, and with whom it shares its tree
  BoundJoint bound{.friction = prepared.friction};
  bound.joint = joint;
  bound.dof = m->jnt_dofadr[joint];
  bound.position = m->jnt_qposadr[joint];
  if (const auto found = others.find(m->dof_treeid[bound.dof]); found != others.end()) {
    bound.instances += static_cast<int>(found->second.size());
  }
  bound.initial_energy = prepared.initial_energy;
  bound.needs_load = NeedsLoad(prepared.description);
  bound.needs_ambient = prepared.description.level_per_temperature != 0;
  return bound;
}

}  // namespace

BoundJoints::BoundJoints(const mjModel* m, int instance, int states)
    : instance_(instance),
      model_(m),
      text_(AttributeText(m, instance)),
      signature_(m->signature),
      passive_(!DrivenByActuators(m, instance)) {
  // what moves the joints, what reads them, and numbers that a user may change
  if (passive_) {
    BindPassive(m, states);
  } else {
    BindActuators(m);
  }
  ReadDrives(m);
  BindSensors(m);
  BindNumbers(m);
}

void BoundJoints::BindActuators(const mjModel* m) {
  // the instance's joints in the order of its actuators
  const auto prepared = PrepareInstance(m, instance_, {InstanceName(m, instance_)});
  const OtherInstances others = FindOthers(m, instance_);
  for (const auto& [joint, i, friction] : FindJoints(m, instance_, *prepared)) {
    // refuse what the engine would accept and friction cannot
    const Place place{ActuatorName(m, i)};
    CheckActuator(m, i, friction->friction);
    BoundJoint bound = BindJoint(m, joint, *friction, others);
    CheckJoint(m, joint, bound.friction, BristlesOf(bound.instances), place);
    if (bound.needs_ambient && m->actuator_ctrlnum[i] == 0) {
      Refuse(place, "has no control, which would be the ambient temperature's rise");
    }

    // where the engine keeps what it needs and gives
    bound.actuator = i;
    bound.state = m->actuator_actadr[i];
    bound.control = m->actuator_ctrlnum[i] > 0 ? m->actuator_ctrladr[i] : -1;
    bound.output = m->actuator_outadr[i];
    joints_.push_back(std::move(bound));
  }
}

void BoundJoints::BindPassive(const mjModel* m, int states) {
  // in the order of joints, each with its states behind those of the reports
  const std::string name = InstanceName(m, instance_);
  const auto prepared = PrepareInstance(m, instance_, {name});
  const OtherInstances others = FindOthers(m, instance_);
  int state = m->plugin_stateadr[instance_] + states;
  for (const auto& [joint, actuator, friction] : FindJoints(m, instance_, *prepared)) {
    const Place place{fmt::format("{}: {}", name, JointName(m, joint))};
    CheckAlone(m, instance_, joint);
    BoundJoint bound = BindJoint(m, joint, *friction, others);
    CheckJoint(m, joint, bound.friction, BristlesOf(bound.instances), place);
    bound.state = state;
    state += static_cast<int>(bound.friction.state().size());
    joints_.push_back(std::move(bound));
  }
}

void BoundJoints::ReadDrives(const mjModel* m) {
  const std::vector<double> drives = StiffestDrives(m, m->opt.integrator);
  for (BoundJoint& joint : joints_) joint.drive = drives[m->dof_treeid[joint.dof]];
}

void BoundJoints::BindSensors(const mjModel* m) {
  for (int i = 0; i < m->nsensor; ++i) {
    if (m->sensor_plugin[i] != instance_) continue;
    if (m->sensor_objtype[i] != mjOBJ_UNKNOWN) {
      Refuse(
          {fmt::format("sensor '{}'", NameIn(m, mjOBJ_SENSOR, i))},
          "names an object; a sensor of friction reads all joints of its instance, leave it out");
    }
    sensors_.push_back(i);
  }
}

void BoundJoints::BindNumbers(const mjModel* m) {
  // only a named instance can have numbers in the model
  const std::string start = NameIn(m, mjOBJ_PLUGIN, instance_) + "/";
  if (start == "/") return;
  for (int i = 0; i < m->nnumeric; ++i) {
    const std::string name = NameIn(m, mjOBJ_NUMERIC, i);
    if (!name.starts_with(start)) continue;
    const Place place{fmt::format("numeric '{}'", name)};

    // a place in each joint's friction that has the number
    NumberArray array;
    array.address = m->numeric_adr[i];
    const std::string number = name.substr(start.size());
    array.initial_energy = number == "initial_energy";
    bool known = array.initial_energy;
    for (const BoundJoint& joint : joints_) {
      array.places.push_back(joint.friction.FindNumber(number));
      known = known || array.places.back();
    }
    if (!known) Refuse(place, "no joint's friction has a number '{}'", Excerpt(number));
    if (static_cast<size_t>(m->numeric_size[i]) != joints_.size()) {
      Refuse(place, "has {} numbers; give {}, one for each joint of {}", m->numeric_size[i],
             joints_.size(), InstanceName(m, instance_));
    }

    // no number equals this one, so that the first look sets them all
    array.last.assign(joints_.size(), std::numeric_limits<double>::quiet_NaN());
    numbers_.push_back(std::move(array));
  }
}

bool BoundJoints::ReadArrays(const mjModel* m) {
  bool any = false;
  // a number that changed since the last look goes into its joint's friction
  for (NumberArray& array : numbers_) {
    const mjtNum* now = m->numeric_data + array.address;
    for (size_t i = 0; i < joints_.size(); ++i) {
      if (now[i] == array.last[i]) continue;
      array.last[i] = now[i];
      if (array.initial_energy && std::isfinite(now[i])) joints_[i].initial_energy[0] = now[i];
      if (array.places[i]) joints_[i].friction.SetNumber(*array.places[i], now[i]);
      any = true;
    }
  }
  return any;
}

int SensorSize(const mjModel* m, int instance) {
  // the passive form names its joints, the other has actuators
  if (!DrivenByActuators(m, instance)) {
    const auto prepared = PrepareInstance(m, instance, {InstanceName(m, instance)});
    return kSensed * static_cast<int>(prepared->joints.size());
  }
  const int *begin = m->actuator_plugin, *end = begin + m->nactuator;
  return kSensed * static_cast<int>(std::count(begin, end, instance));
}

}  // namespace warmjoint
