#include "sim/plugin/friction_instance.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "models/foundation/bad_input.h"
#include "sim/plugin/check_actuator.h"
#include "sim/plugin/check_joint.h"

namespace warmjoint::inline sim {
namespace {

/// Whether the actuator's group is switched off.
bool Disabled(const mjModel* m, int actuator) {
  const int group = m->actuator_group[actuator];
  return group >= 0 && group < 31 && (m->opt.disableactuator >> group & 1);
}

/// Whether the engine leaves out all passive forces.
bool PassiveForcesOff(const mjModel* m) {
  constexpr int both = mjDSBL_SPRING | mjDSBL_DAMPER;
  return (m->opt.disableflags & both) == both;
}

double Finite(double value) { return std::isfinite(value) ? value : 0; }

}  // namespace

FrictionInstance::FrictionInstance(const mjModel* m, int instance)
    : instance_(instance), bound_(m, instance, kFrictionReports) {
  Rebind(m);
}

/// Finds the joints in the model that the instance is called with.
void FrictionInstance::Bind(const mjModel* m) {
  if (!bound_.FitsModel(m)) Rebind(m);
  if (bound_.ReadNumbers(m)) checked_ = false;
  if (timestep_ != m->opt.timestep) SetTimestep(m);
}

/// Makes scratch of the right size, and the joints ready for the model's step.
void FrictionInstance::Rebind(const mjModel* m) {
  if (!bound_.FitsModel(m)) bound_ = BoundJoints(m, instance_, kFrictionReports);
  size_t states = 0;
  bool load = false;
  for (const BoundJoint& joint : bound_.joints()) {
    states += joint.friction.state().size();
    load = load || joint.needs_load;
  }
  force_.assign(bound_.joints().size(), 0);
  sensed_.assign(kSensed * bound_.joints().size(), 0);
  next_.assign(states, 0);
  load_.assign(load && bound_.passive() ? static_cast<size_t>(m->nv) : 0, 0);
  SetTimestep(m);
  checked_ = true;
  stepped_ = false;
}

void FrictionInstance::SetTimestep(const mjModel* m) {
  timestep_ = m->opt.timestep;
  for (BoundJoint& joint : bound_.joints()) joint.friction.SetTimestep(timestep_);
  checked_ = false;
}

/// A step or a number that a program set after loading is taken as it is, with a word about what it
/// does.
void FrictionInstance::WarnOfTimestep(const mjModel* m, mjData* d) {
  checked_ = true;
  mjtNum& reported = d->plugin_state[m->plugin_stateadr[instance_] + kReportsStep];
  if (reported != 0) return;
  for (const BoundJoint& joint : bound_.joints()) {
    try {
      CheckJoint(m, joint.joint, joint.friction, {JointName(m, joint.joint)});
    } catch (const BadInput& refusal) {
      reported = 1;
      mju_warning("%s: what was set at %g s is beyond what the step bears: %s", kFrictionPlugin,
                  d->time, refusal.what());
      return;
    }
  }
}

void FrictionInstance::Prepare(const mjModel* m, mjData* d) {
  Bind(m);
  if (!checked_) WarnOfTimestep(m, d);
  stepped_ = true;
}

JointMotion FrictionInstance::MotionOf(const mjModel* m, const mjData* d,
                                       const BoundJoint& joint) const {
  JointMotion motion;
  motion.position = d->qpos[joint.position];
  motion.velocity = d->qvel[joint.dof];
  motion.inertia = EffectiveInertia(m, d, joint.dof);
  if (!joint.needs_load) return motion;
  // passive forces come before the engine knows the bias
  const auto dof = static_cast<size_t>(joint.dof);
  motion.load = bound_.passive() ? load_[dof] : d->qfrc_bias[dof];
  return motion;
}

FrictionStep FrictionInstance::StepJoint(const mjModel* m, mjData* d, size_t i,
                                         const FrictionState& now, double ambient_rise) {
  const BoundJoint& joint = bound_.joints()[i];
  JointMotion motion = MotionOf(m, d, joint);
  motion.ambient_rise = ambient_rise;
  FrictionStep step = joint.friction.Step(now, motion);
  if (step.feeds_itself) Report(m, d, joint);

  // a speed without bound must not stay in the heat
  if (!std::isfinite(step.force + step.next.energy + step.next.second_energy)) {
    step.force = 0;
    step.next = now;
  }
  force_[i] = step.force;
  if (!bound_.sensors().empty()) {
    const double energy = now.energy + now.second_energy;
    const double rise = joint.friction.level_per_temperature() != 0
                            ? energy / joint.friction.level_per_temperature()
                            : 0;
    const double held = step.sliding ? 0 : 1;
    double* sensed = sensed_.data() + kSensed * i;
    for (const double value : {-step.force, energy, rise, step.loss, held}) *sensed++ = value;
  }
  return step;
}

void FrictionInstance::StepActuators(const mjModel* m, mjData* d) {
  Prepare(m, d);
  const double rate = m->opt.integrator == mjINT_RK4 ? 0 : 1 / timestep_;
  const bool starts = d->plugin_state[m->plugin_stateadr[instance_] + kStartsWarm] != 0;
  double* next = next_.data();
  for (size_t i = 0; i < bound_.joints().size(); ++i) {
    const BoundJoint& joint = bound_.joints()[i];
    const double ambient = joint.needs_ambient ? Finite(d->ctrl[joint.control]) : 0;
    const mjtNum* act = d->act + joint.state;
    FrictionState now = joint.friction.Load(act);
    if (starts && now.energy == 0 && now.second_energy == 0) {
      now.energy = joint.initial_energy[0];
      now.second_energy = joint.initial_energy[1];
    }
    joint.friction.Store(StepJoint(m, d, i, now, ambient).next, next);

    mjtNum* act_dot = d->act_dot + joint.state;
    for (size_t k = 0; k < joint.friction.state().size(); ++k) {
      act_dot[k] = (*next++ - act[k]) * rate;
    }
  }
}

void FrictionInstance::ApplyActuators(const mjModel* m, mjData* d) const {
  for (size_t i = 0; i < bound_.joints().size(); ++i) {
    const BoundJoint& joint = bound_.joints()[i];
    d->actuator_force[joint.output] = Disabled(m, joint.actuator) ? 0 : -force_[i];
  }
}

void FrictionInstance::StepPassive(const mjModel* m, mjData* d) {
  Prepare(m, d);
  if (!load_.empty()) mj_rne(m, d, 0, load_.data());
  const double ambient = Finite(d->plugin_state[m->plugin_stateadr[instance_] + kAmbientRise]);
  double* next = next_.data();
  for (size_t i = 0; i < bound_.joints().size(); ++i) {
    const BoundJoint& joint = bound_.joints()[i];
    const FrictionState now = joint.friction.Load(d->plugin_state + joint.state);
    const FrictionStep step = StepJoint(m, d, i, now, ambient);
    joint.friction.Store(step.next, next);
    next += joint.friction.state().size();
    d->qfrc_passive[joint.dof] -= step.force;
  }
}

void FrictionInstance::Reset(const mjModel* m, mjtNum* state) {
  Bind(m);
  std::fill_n(state, m->plugin_statenum[instance_], 0.0);
  stepped_ = false;
  mjtNum* next = state + kFrictionReports;
  for (const BoundJoint& joint : bound_.joints()) {
    const auto& [first, second] = joint.initial_energy;
    if (!passive()) {
      if (first != 0 || second != 0) state[kStartsWarm] = 1;
      continue;
    }
    FrictionState initial;
    initial.energy = first;
    initial.second_energy = second;
    joint.friction.Store(initial, next);
    next += joint.friction.state().size();
  }
}

void FrictionInstance::Sense(const mjModel* m, mjData* d) {
  if (bound_.sensors().empty()) return;
  const bool off = passive() ? PassiveForcesOff(m) : m->opt.disableflags & mjDSBL_ACTUATION;
  // sensors come before the actuators, which will step once more
  if (!passive() && !off) StepActuators(m, d);
  if (off) std::fill(sensed_.begin(), sensed_.end(), 0.0);
  for (const int address : bound_.sensors()) {
    std::copy(sensed_.begin(), sensed_.end(), d->sensordata + address);
  }
}

void FrictionInstance::Advance(const mjModel* m, mjData* d) {
  if (!stepped_) return;
  stepped_ = false;
  const double* next = next_.data();
  if (bound_.passive()) {
    if (PassiveForcesOff(m)) return;
    mjtNum* state = d->plugin_state + m->plugin_stateadr[instance_];
    state[kAmbientRise] = Finite(state[kAmbientRise]);
    std::copy_n(next, next_.size(), state + kFrictionReports);
    return;
  }
  if (m->opt.disableflags & mjDSBL_ACTUATION) return;
  d->plugin_state[m->plugin_stateadr[instance_] + kStartsWarm] = 0;
  const bool all = m->opt.integrator == mjINT_RK4;
  for (const BoundJoint& joint : bound_.joints()) {
    const size_t states = joint.friction.state().size();
    mjtNum* act = d->act + joint.state;
    const bool finite = std::all_of(act, act + states, [](double x) { return std::isfinite(x); });
    const bool writes = (all && !Disabled(m, joint.actuator)) || !finite;
    if (writes) std::copy_n(next, states, act);
    next += states;
  }
}

void FrictionInstance::Report(const mjModel* m, mjData* d, const BoundJoint& joint) {
  // a double counts 52 joints; those beyond share the last place
  const auto place = std::min<ptrdiff_t>(&joint - bound_.joints().data(), 51);
  const uint64_t bit = uint64_t{1} << place;
  mjtNum& reported = d->plugin_state[m->plugin_stateadr[instance_] + kReportsPush];
  const auto before = static_cast<uint64_t>(reported);
  if (before & bit) return;
  reported = static_cast<mjtNum>(before | bit);
  const std::string name =
      joint.actuator < 0 ? JointName(m, joint.joint) : ActuatorName(m, joint.actuator);
  mju_warning(
      "%s: %s: at %g s friction would push the joint (its level is below 0 at %g rad/s or m/s); it "
      "is held at 0 from here on, and friction is outside its domain",
      kFrictionPlugin, name.c_str(), d->time, d->qvel[joint.dof]);
}

}  // namespace warmjoint::inline sim
