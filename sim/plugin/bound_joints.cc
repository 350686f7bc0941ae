#include "sim/plugin/bound_joints.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/friction/thermal.h"
#include "sim/plugin/plugin_instances.h"
#include "sim/plugin/register.h"

namespace warmjoint {
namespace {

/// others: the other instances on each kinematic tree.
BoundJoint BindJoint(const mjModel* m, int joint, const PreparedJoint& prepared,
                     const InstanceOptions& options, const OtherInstances& others) {
  // where the engine keeps its numbers, and with whom it shares its tree
  BoundJoint bound{.friction = prepared.friction};
  bound.joint = joint;
  bound.dof = m->jnt_dofadr[joint];
  bound.position = m->jnt_qposadr[joint];
  if (const auto found = others.find(m->dof_treeid[bound.dof]); found != others.end()) {
    bound.instances += static_cast<int>(found->second.size());
  }
  bound.initial_energy = prepared.initial_energy;
  if (options.viscous_as_damping && bound.friction.FindNumber(kViscousName)) {
    bound.viscous = Viscous::by_damping;
    bound.damping = std::numeric_limits<double>::quiet_NaN();  // so that the first look sets it
  }
  bound.needs_load = NeedsLoad(prepared.description);
  bound.needs_ambient = prepared.description.level_per_temperature != 0;
  return bound;
}

/// Where the engine keeps what a joint of the actuator form needs and gives.
void BindActuator(const mjModel* m, int actuator, const Place& place, BoundJoint& bound) {
  const bool has_control = m->actuator_ctrlnum[actuator] > 0;
  if (bound.needs_ambient && !has_control) {
    Refuse(place, "has no control, which would be the ambient temperature's rise");
  }
  bound.actuator = actuator;
  bound.state = m->actuator_actadr[actuator];
  bound.control = has_control ? m->actuator_ctrladr[actuator] : -1;
  bound.output = m->actuator_outadr[actuator];
}

}  // namespace

BoundJoints::BoundJoints(const mjModel* m, int instance)
    : instance_(instance),
      model_(m),
      text_(AttributeText(m, instance)),
      signature_(m->signature),
      passive_(!DrivenByActuators(m, instance)) {
  // what moves the joints, what reads them, and numbers that a user may change
  BindJoints(m);
  ReadDampings(m);
  ReadInertias(m);
  CheckJoints(m);
  ReadDrives(m);
  BindSensors(m);
  BindNumbers(m);
}

void BoundJoints::BindJoints(const mjModel* m) {
  // in the order of actuators, or of joints in the passive form, whose states stand behind those of the reports
  const InstanceOptions options = PrepareInstance(m, instance_)->options;
  stiffest_drive_ = options.stiffest_drive;
  const OtherInstances others = FindOthers(m, instance_);
  int state = m->plugin_stateadr[instance_] + kFrictionReports;
  for (const auto& [joint, actuator, prepared] : FindJoints(m, instance_)) {
    // refuse what the engine would accept and friction cannot
    const Place place = PlaceOf(m, joint, actuator);
    passive_ ? CheckAlone(m, instance_, joint) : CheckActuator(m, actuator, prepared->friction);
    BoundJoint bound = BindJoint(m, joint, *prepared, options, others);
    if (passive_) {
      bound.state = state;
      state += static_cast<int>(bound.friction.state().size());
    } else {
      BindActuator(m, actuator, place, bound);
    }
    joints_.push_back(std::move(bound));
  }
}

/// What messages call a joint of the instance.
Place BoundJoints::PlaceOf(const mjModel* m, int joint, int actuator) const {
  if (!passive_) return {ActuatorName(m, actuator)};
  return {fmt::format("{}: {}", InstanceName(m, instance_), JointName(m, joint))};
}

void BoundJoints::CheckJoints(const mjModel* m) const {
  for (const BoundJoint& joint : joints_) {
    CheckJoint(m, joint.joint, Stepped(m, joint), BristlesOf(joint.instances),
               PlaceOf(m, joint.joint, joint.actuator));
  }
}

void BoundJoints::ReadDrives(const mjModel* m) {
  const std::vector<double> drives = StiffestDrives(m, m->opt.integrator, Slopes(m));
  for (BoundJoint& joint : joints_) {
    joint.drive = std::max(stiffest_drive_, drives[m->dof_treeid[joint.dof]]);
  }
}

bool BoundJoints::ReadInertias(const mjModel* m) {
  const auto nv = static_cast<size_t>(m->nv);
  const auto same = [&](const mjtNum* now, size_t from) {
    return std::memcmp(now, inertias_.data() + from, nv * sizeof(mjtNum)) == 0;
  };
  const bool first = inertias_.empty();
  const bool constant = !first && same(m->dof_invweight0, nv) && same(m->dof_M0, 2 * nv);
  if (constant && same(m->dof_armature, 0)) [[likely]]
    return false;
  // the compiler and mj_setConst know the armatures of their time
  if (!constant) armatures_.assign(m->dof_armature, m->dof_armature + nv);
  inertias_.assign(m->dof_armature, m->dof_armature + nv);
  inertias_.insert(inertias_.end(), m->dof_invweight0, m->dof_invweight0 + nv);
  inertias_.insert(inertias_.end(), m->dof_M0, m->dof_M0 + nv);
  return true;
}

SteppedFriction BoundJoints::Stepped(const mjModel* m, const BoundJoint& joint) const {
  // of an uncoupled one the engine itself takes dof_M0
  const double known = EffectiveInertia(m, joint.dof);
  const double more = m->dof_armature[joint.dof] - armatures_[static_cast<size_t>(joint.dof)];
  const bool fixed = known == 0 || m->dof_simplenum[joint.dof] > 0;
  return {joint.friction, joint.viscous, fixed ? known : known + more};
}

std::vector<double> BoundJoints::Slopes(const mjModel* m) const {
  std::vector<double> slopes(static_cast<size_t>(m->nv), 0);
  for (const BoundJoint& joint : joints_) {
    const auto [first, second] = joint.initial_energy;
    const double warm = joint.friction.viscous_per_energy() * (first + second);
    slopes[static_cast<size_t>(joint.dof)] = Stepped(m, joint).OwnSlope() + std::max(0.0, warm);
  }
  return slopes;
}

void BoundJoints::BindSensors(const mjModel* m) {
  const std::string name = InstanceName(m, instance_);
  const bool of_joints = PrepareInstance(m, instance_)->options.joint_sensors;
  for (int i = 0; i < m->nsensor; ++i) {
    if (m->sensor_plugin[i] != instance_) continue;
    const Place place{fmt::format("sensor '{}'", NameIn(m, mjOBJ_SENSOR, i))};
    if (!of_joints) {
      if (m->sensor_objtype[i] != mjOBJ_UNKNOWN) {
        Refuse(place,
               "names an object, and reads all joints of its instance; leave it out, or give the "
               "instance joint_sensors");
      }
      sensors_.push_back({i});
      continue;
    }
    // of one joint, which must be the instance's
    if (m->sensor_objtype[i] != mjOBJ_JOINT) {
      Refuse(place, "must name a joint, since its instance has joint_sensors");
    }
    const auto joint = std::ranges::find(joints_, m->sensor_objid[i], &BoundJoint::joint);
    if (joint == joints_.end()) {
      Refuse(place, "names {}, on which {} does not act", JointName(m, m->sensor_objid[i]), name);
    }
    sensors_.push_back({i, static_cast<size_t>(joint - joints_.begin())});
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
    const std::string number = name.substr(start.size());

    // heat at a reset is of the joints that have a gain of that stage
    NumberArray array;
    array.name = name;
    array.address = m->numeric_adr[i];
    std::string needed = number;
    for (const size_t stage : {0, 1}) {
      if (number != kInitialEnergies[stage]) continue;
      array.stage = stage;
      needed = fmt::format("{}{}", stage == 0 ? "" : kSecondStage, kGainName);
    }

    // a place in each joint's friction that has the number
    for (const BoundJoint& joint : joints_) {
      if (joint.viscous == Viscous::by_damping && number == kViscousName) {
        Refuse(place, "{} has its viscous in dof_damping of the model; take the array out",
               JointName(m, joint.joint));
      }
      const auto found = joint.friction.FindNumber(needed);
      array.places.push_back(found);
      const double given = !found        ? 0
                           : array.stage ? joint.initial_energy[*array.stage]
                                         : joint.friction.Number(*found);
      array.given.push_back(given);
    }
    if (std::ranges::none_of(array.places, [](const auto& found) { return found.has_value(); })) {
      Refuse(place, "no joint's friction has a number '{}'", Excerpt(number));
    }
    if (static_cast<size_t>(m->numeric_size[i]) != joints_.size()) {
      Refuse(place, "has {} numbers; give {}, one for each joint of {}", m->numeric_size[i],
             joints_.size(), InstanceName(m, instance_));
    }

    // no number equals this one, so that the first look sets them all
    array.last.assign(joints_.size(), std::numeric_limits<double>::quiet_NaN());
    array.told.assign(joints_.size(), false);
    numbers_.push_back(std::move(array));
  }
}

/// Takes over the dampings that are a joint's viscous.
bool BoundJoints::ReadDampings(const mjModel* m) {
  bool any = false;
  const bool off = m->opt.disableflags & mjDSBL_DAMPER;
  for (BoundJoint& joint : joints_) {
    if (joint.viscous == Viscous::by_plugin) continue;
    const double now = off ? 0 : m->dof_damping[joint.dof];
    if (now == joint.damping) continue;
    joint.damping = now;
    any = true;
    // the engine itself takes any number; friction's slope is not below 0
    joint.friction.SetNumber(*joint.friction.FindNumber(kViscousName), std::max(0.0, now));
  }
  return any;
}

bool BoundJoints::ReadNumbers(const mjModel* m) {
  bool any = ReadDampings(m);
  // a number that changed since the last look goes into its joint's friction
  for (NumberArray& array : numbers_) {
    const mjtNum* now = m->numeric_data + array.address;
    for (size_t i = 0; i < joints_.size(); ++i) {
      if (now[i] == array.last[i] || !array.places[i]) continue;
      array.last[i] = now[i];
      any = true;
      if (SetNumber(array, i, now[i])) continue;
      SetNumber(array, i, array.given[i]);
      if (!array.told[i]) WarnOfNumber(m, array, i, now[i]);
    }
  }
  return any;
}

/// Sets one joint's number; false, and nothing changed, where it is out of its bounds.
bool BoundJoints::SetNumber(const NumberArray& array, size_t i, double value) {
  if (!array.stage) return joints_[i].friction.SetNumber(*array.places[i], value);
  if (!std::isfinite(value)) return false;
  joints_[i].initial_energy[*array.stage] = value;
  return true;
}

void BoundJoints::WarnOfNumber(const mjModel* m, NumberArray& array, size_t i, double value) const {
  array.told[i] = true;
  const BoundJoint& joint = joints_[i];
  const Bounds bounds = array.stage ? Bounds() : joint.friction.NumberBounds(*array.places[i]);
  const std::string warning =
      fmt::format("numeric '{}' of {} is {}; it must be {}; {} acts instead", array.name,
                  JointName(m, joint.joint), value, bounds.Words(), array.given[i]);
  mju_warning("%s: %s", kFrictionPlugin, warning.c_str());
}

int SensorSize(const mjModel* m, int instance) {
  const auto prepared = PrepareInstance(m, instance);
  if (prepared->options.joint_sensors) return kSensed;
  // the passive form names its joints, the other has actuators
  if (!DrivenByActuators(m, instance)) return kSensed * static_cast<int>(prepared->joints.size());
  const int *begin = m->actuator_plugin, *end = begin + m->nactuator;
  return kSensed * static_cast<int>(std::count(begin, end, instance));
}

}  // namespace warmjoint
