#include "sim/plugin/friction_instance.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "models/foundation/bad_input.h"
#include "sim/plugin/plugin_instances.h"
#include "sim/plugin/register.h"
#include "sim/plugin/stability.h"

namespace warmjoint {
namespace {

/// Whether a group of actuators is switched off.
bool Disabled(const mjModel* m, int group) {
  return group >= 0 && group < 31 && (m->opt.disableactuator >> group & 1);
}

/// Whether the engine leaves out all passive forces.
bool PassiveForcesOff(const mjModel* m) {
  constexpr int both = mjDSBL_SPRING | mjDSBL_DAMPER;
  return (m->opt.disableflags & both) == both;
}

double Finite(double value) { return std::isfinite(value) ? value : 0; }

/// Warns, once until a reset, of a joint whose step or numbers a program set after loading to what
/// the step does not bear (CheckJoint, CheckDamping), or that drives may shake (CheckDrive); they are taken as
/// they are.
void WarnOfNumbers(const mjModel* m, mjData* d, int instance, const BoundJoints& bound) {
  mjtNum& reported = d->plugin_state[m->plugin_stateadr[instance] + kReportsStep];
  // once after a reset
  if (reported != 0) return;
  const std::vector<double> slopes = bound.Slopes(m);
  for (const BoundJoint& joint : bound.joints()) {
    try {
      const Place place{JointName(m, joint.joint)};
      const SteppedFriction stepped = bound.Stepped(m, joint);
      CheckJoint(m, joint.joint, stepped, BristlesOf(joint.instances), place);
      CheckDamping(m, joint.joint, stepped, place);
      CheckDrive(m, joint.joint, joint.drive, slopes, place);
    } catch (const BadInput& refusal) {
      reported = 1;
      mju_warning("%s: at %g s the model is beyond what its step bears: %s", kFrictionPlugin,
                  d->time, refusal.what());
      return;
    }
  }
}

/// Warns, once until a reset for each joint, that friction would push it. place: of the joint.
void WarnOfPush(const mjModel* m, mjData* d, int instance, const std::vector<BoundJoint>& joints,
                size_t place) {
  // a double counts 52 joints; those beyond share the last place
  const uint64_t bit = uint64_t{1} << std::min<size_t>(place, 51);
  mjtNum& reported = d->plugin_state[m->plugin_stateadr[instance] + kReportsPush];
  // once for each joint
  const auto before = static_cast<uint64_t>(reported);
  if (before & bit) return;
  reported = static_cast<mjtNum>(before | bit);
  const BoundJoint& joint = joints[place];
  const std::string name =
      joint.actuator < 0 ? JointName(m, joint.joint) : ActuatorName(m, joint.actuator);
  mju_warning(
      "%s: %s: at %g s friction would push the joint (its level is below 0 at %g rad/s or m/s); it "
      "is held at 0 from here on, and friction is outside its domain",
      kFrictionPlugin, name.c_str(), d->time, d->qvel[joint.dof]);
}

}  // namespace

void FrictionSensors::Ask(const mjModel* m, mjData* d, const BoundJoints& bound, bool off) {
  // sensors are told at the stage of positions, and written by the step that follows
  asked_ = !off;
  if (!off) return;
  sensed_.assign(kSensed * bound.joints().size(), 0);
  Write(m, d, bound);
}

void FrictionSensors::WriteStep(const mjModel* m, mjData* d, const BoundJoints& bound,
                                const JointRows& rows) {
  asked_ = false;
  const std::vector<BoundJoint>& joints = bound.joints();

  // force, heat, its rise of temperature, loss, and whether it holds
  sensed_.clear();
  for (size_t i = 0; i < joints.size(); ++i) {
    const auto [first, second] = rows.energies(i);
    const double energy = first + second;
    const double per_temperature = joints[i].friction.level_per_temperature();
    const double rise = per_temperature != 0 ? energy / per_temperature : 0;
    const double held = rows.slides(i) ? 0 : 1;
    for (const double value : {-rows.force(i), energy, rise, rows.loss(i), held}) {
      sensed_.push_back(value);
    }
  }
  Write(m, d, bound);
}

void FrictionSensors::Write(const mjModel* m, mjData* d, const BoundJoints& bound) const {
  for (const auto& [sensor, joint] : bound.sensors()) {
    // of one joint, or of all
    mjtNum* data = d->sensordata + m->sensor_adr[sensor];
    const auto begin = sensed_.begin() + static_cast<std::ptrdiff_t>(kSensed * joint.value_or(0));
    const size_t size = joint ? kSensed : sensed_.size();
    std::copy_n(begin, size, data);

    // the engine clips what stands there at the stage of positions
    const double most = m->sensor_cutoff[sensor];
    if (most <= 0) continue;
    for (size_t i = 0; i < size; ++i) data[i] = std::clamp(data[i], -most, most);
  }
}

FrictionInstance::FrictionInstance(const mjModel* m, int instance)
    : instance_(instance), bound_(m, instance) {
  Rebind(m);
}

/// Finds the joints in the model that the instance is called with.
void FrictionInstance::Bind(const mjModel* m) {
  if (bound_.FitsModel(m)) [[likely]]
    return;
  bound_ = BoundJoints(m, instance_);
  Rebind(m);
}

/// Takes over what may be set between two steps.
void FrictionInstance::TakeNumbers(const mjModel* m) {
  const bool other_inertias = bound_.ReadInertias(m), other_numbers = bound_.ReadNumbers(m);
  const bool same = timestep_ == m->opt.timestep && integrator_ == m->opt.integrator &&
                    flags_ == m->opt.disableflags;
  if (same && !other_inertias && !other_numbers) [[likely]]
    return;
  bound_.ReadDrives(m);
  ReadNumbers(m);
}

/// Makes scratch of the right size, and the joints ready for the model's step.
void FrictionInstance::Rebind(const mjModel* m) {
  const std::vector<BoundJoint>& joints = bound_.joints();
  // what has to be found for the joints at each step
  const bool needs_load = std::ranges::any_of(joints, &BoundJoint::needs_load);
  needs_ambient_ = std::ranges::any_of(joints, &BoundJoint::needs_ambient);

  // where the engine wants forces and states of those that actuators drive
  driven_.clear();
  for (const BoundJoint& joint : joints) {
    if (bound_.passive()) break;
    driven_.push_back({m->actuator_group[joint.actuator], joint.state,
                       static_cast<int>(joint.friction.state().size()), joint.output});
  }

  // scratch of the model's size
  load_.assign(needs_load && bound_.passive() ? static_cast<size_t>(m->nv) : 0, 0);
  rows_ = JointRows(m, joints);
  left_ = LeftStates(joints);

  // a model that was saved before there was a mark has no place for it
  const int entries = m->plugin_statenum[instance_];
  const size_t own = bound_.passive() ? rows_.next().size() : 0;
  mark_ = entries == kFrictionEntries + static_cast<int>(own) ? entries - 1 : -1;
  ReadNumbers(m);
  // binding has checked all but the drives and what damping may be
  checked_ = std::ranges::all_of(joints, [](const BoundJoint& joint) {
    return joint.drive == 0 && joint.viscous == Viscous::by_plugin;
  });
  stepped_ = false;
}

void FrictionInstance::ReadNumbers(const mjModel* m) {
  timestep_ = m->opt.timestep;
  integrator_ = m->opt.integrator;
  flags_ = m->opt.disableflags;
  for (BoundJoint& joint : bound_.joints()) joint.friction.SetTimestep(timestep_);
  rows_.ReadNumbers(m, bound_.joints());
  checked_ = false;
}

/// Whether a step begins where the last one has ended, in this model.
bool FrictionInstance::GoesOn(const mjModel* m, const mjData* d) const {
  if (mark_ < 0 || !bound_.Undisturbed(m)) return false;
  const mjtNum mark = d->plugin_state[m->plugin_stateadr[instance_] + mark_];
  return mark == bound_.mark() && left_.Match(passive() ? d->plugin_state : d->act, d->time);
}

void FrictionInstance::Prepare(const mjModel* m, mjData* d) {
  if (!GoesOn(m, d)) Bind(m);
  TakeNumbers(m);
  // told once: numbers that a user set and the step does not bear
  if (!checked_) [[unlikely]] {
    WarnOfNumbers(m, d, instance_, bound_);
    checked_ = true;
  }
  stepped_ = true;
}

/// Steps all joints from the states that rows_ has. load: of each degree of freedom.
void FrictionInstance::Step(const mjModel* m, mjData* d, const mjtNum* load) {
  rows_.Step(m, load);
  for (const size_t place : rows_.pushed()) {
    WarnOfPush(m, d, instance_, bound_.joints(), place);
  }
  sensors_.Note(m, d, bound_, rows_);
}

void FrictionInstance::StepActuators(const mjModel* m, mjData* d) {
  Prepare(m, d);
  rows_.Load(d, bound_.joints(), d->act);
  const bool warm = d->plugin_state[m->plugin_stateadr[instance_] + kStartsWarm] != 0;
  if (warm || needs_ambient_) BeginJoints(d, warm);
  Step(m, d, d->qfrc_bias);

  // a step of Euler lands on the next states; stages of Runge-Kutta change nothing
  euler_ = integrator_ != mjINT_RK4 && left_.FindRates(rows_.next(), d->act, timestep_, d->act_dot);
}

/// Takes over the controls that tell an ambient. warm: whether the joints are to have their first heat.
void FrictionInstance::BeginJoints(const mjData* d, bool warm) {
  // numbers that are none must not reach the heat
  const std::vector<BoundJoint>& joints = bound_.joints();
  for (size_t i = 0; i < joints.size(); ++i) {
    const BoundJoint& joint = joints[i];
    if (joint.needs_ambient) rows_.SetAmbientRise(i, Finite(d->ctrl[joint.control]));
    if (warm && rows_.energies(i) == std::array{0.0, 0.0})
      rows_.SetEnergies(i, joint.initial_energy);
  }
}

void FrictionInstance::ApplyActuators(const mjModel* m, mjData* d) const {
  rows_.GiveTo(d->actuator_force);

  // none where the group is switched off
  if (m->opt.disableactuator == 0) [[likely]]
    return;
  for (const Driven& joint : driven_) {
    if (Disabled(m, joint.group)) d->actuator_force[joint.output] = 0;
  }
}

void FrictionInstance::StepPassive(const mjModel* m, mjData* d) {
  Prepare(m, d);
  // passive forces come before the engine knows the bias
  if (!load_.empty()) mj_rne(m, d, 0, load_.data());
  const std::vector<BoundJoint>& joints = bound_.joints();
  rows_.Load(d, joints, d->plugin_state);
  if (needs_ambient_) {
    const double rise = Finite(d->plugin_state[m->plugin_stateadr[instance_] + kAmbientRise]);
    for (size_t i = 0; i < joints.size(); ++i) rows_.SetAmbientRise(i, rise);
  }
  Step(m, d, load_.data());
  if (!(m->opt.enableflags & mjENBL_SLEEP)) [[likely]]
    return rows_.TakeFrom(d->qfrc_passive);
  // the engine clears the forces of trees that are awake alone
  rows_.TakeFrom(d->qfrc_passive, [&](int dof) { return d->tree_asleep[m->dof_treeid[dof]] < 0; });
}

void FrictionInstance::Reset(const mjModel* m, mjtNum* state) {
  Bind(m);
  TakeNumbers(m);
  std::fill_n(state, m->plugin_statenum[instance_], 0.0);
  if (mark_ >= 0) state[mark_] = bound_.mark();
  stepped_ = false;
  // the passive form has its first heat here, the other takes it at its first step
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
  sensors_.Ask(m, d, bound_, off);
}

void FrictionInstance::Advance(const mjModel* m, mjData* d) {
  if (!stepped_) return;
  stepped_ = false;
  bound_.passive() ? AdvancePassive(m, d) : AdvanceActuators(m, d);
}

void FrictionInstance::AdvancePassive(const mjModel* m, mjData* d) {
  if (PassiveForcesOff(m)) return;
  mjtNum* state = d->plugin_state + m->plugin_stateadr[instance_];
  state[kAmbientRise] = Finite(state[kAmbientRise]);
  left_.Put(rows_.next(), d->plugin_state, d->time);
  if (mark_ >= 0) state[mark_] = bound_.mark();
}

void FrictionInstance::AdvanceActuators(const mjModel* m, mjData* d) {
  if (m->opt.disableflags & mjDSBL_ACTUATION) return;
  mjtNum* state = d->plugin_state + m->plugin_stateadr[instance_];
  // the first heat was taken
  state[kStartsWarm] = 0;
  if (mark_ >= 0) state[mark_] = bound_.mark();

  // the engine has stepped act, but not as RK4 would have it, nor from numbers that are none
  if (euler_) [[likely]]
    return left_.Ended(d->time);
  CorrectActs(m, d);
  left_.Keep(d->act, d->time);
}

/// Writes the next states into act: of all joints under RK4, else where the engine has left none.
void FrictionInstance::CorrectActs(const mjModel* m, mjData* d) const {
  const bool all = m->opt.integrator == mjINT_RK4;
  const double* next = rows_.next().data();
  for (const Driven& joint : driven_) {
    mjtNum* act = d->act + joint.state;
    const bool finite =
        std::all_of(act, act + joint.states, [](double x) { return std::isfinite(x); });
    const bool writes = (all && !Disabled(m, joint.group)) || !finite;
    if (writes) std::copy_n(next, joint.states, act);
    next += joint.states;
  }
}

}  // namespace warmjoint
