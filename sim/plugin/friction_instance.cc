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
  if (bound_.ReadNumbers(m)) {
    ShapeBristles();
    checked_ = false;
  }
  if (timestep_ != m->opt.timestep) SetTimestep(m);
}

/// Makes scratch of the right size, and the joints ready for the model's step.
void FrictionInstance::Rebind(const mjModel* m) {
  if (!bound_.FitsModel(m)) bound_ = BoundJoints(m, instance_, kFrictionReports);
  const size_t joints = bound_.joints().size();
  size_t states = 0;
  needs_load_ = false;
  for (const BoundJoint& joint : bound_.joints()) {
    states += joint.friction.state().size();
    needs_load_ = needs_load_ || joint.needs_load;
  }
  now_.assign(joints, {});
  motion_.assign(joints, {});
  load_state_.assign(joints, 0);
  bristle_.assign(joints, {});
  force_.assign(joints, 0);
  sensed_.assign(kSensed * joints, 0);
  next_.assign(states, 0);
  load_.assign(needs_load_ && bound_.passive() ? static_cast<size_t>(m->nv) : 0, 0);
  BindBristles(m);
  SetTimestep(m);
  checked_ = true;
  stepped_ = senses_ = false;
}

/// Couples the bristles that the step chooses; those of a law are each by itself.
void FrictionInstance::BindBristles(const mjModel* m) {
  std::vector<CoupledJoint> coupled;
  for (size_t i = 0; i < bound_.joints().size(); ++i) {
    const BoundJoint& joint = bound_.joints()[i];
    const double inertia = EffectiveInertia(m, joint.dof);
    if (joint.friction.own_bristle() || inertia <= 0) continue;
    coupled.push_back({i, joint.dof, inertia, joint.instances});
  }
  bristles_ = CoupledBristles(m, coupled);
}

void FrictionInstance::SetTimestep(const mjModel* m) {
  timestep_ = m->opt.timestep;
  for (BoundJoint& joint : bound_.joints()) joint.friction.SetTimestep(timestep_);
  ShapeBristles();
  checked_ = false;
}

void FrictionInstance::ShapeBristles() {
  bristles_.SetTimestep(timestep_,
                        [&](size_t i) { return bound_.joints()[i].friction.SteepestSlope(); });
}

/// A step or a number that a program set after loading is taken as it is, with a word about what it
/// does.
void FrictionInstance::WarnOfTimestep(const mjModel* m, mjData* d) {
  checked_ = true;
  mjtNum& reported = d->plugin_state[m->plugin_stateadr[instance_] + kReportsStep];
  if (reported != 0) return;
  for (const BoundJoint& joint : bound_.joints()) {
    try {
      CheckJoint(m, joint.joint, joint.friction, BristlesOf(joint.instances),
                 {JointName(m, joint.joint)});
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

void FrictionInstance::ReadMotion(const mjModel* m, const mjData* d) {
  // passive forces come before the engine knows the bias
  const mjtNum* load = bound_.passive() ? load_.data() : d->qfrc_bias;
  for (size_t i = 0; i < motion_.size(); ++i) {
    const BoundJoint& joint = bound_.joints()[i];
    JointMotion& motion = motion_[i];
    motion.position = d->qpos[joint.position];
    motion.velocity = d->qvel[joint.dof];
    if (joint.needs_load) motion.load = load[joint.dof];
    if (joint.friction.own_bristle()) motion.inertia = EffectiveInertia(m, d, joint.dof);
    load_state_[i] = now_[i].bristle;
  }
}

/// Steps all joints from now_ and their ambient_rise to force_ and next_.
void FrictionInstance::StepJoints(const mjModel* m, mjData* d) {
  const std::vector<BoundJoint>& joints = bound_.joints();
  ReadMotion(m, d);
  const auto level = [&](size_t i, int side) {
    return joints[i].friction.Level(side, now_[i], motion_[i]);
  };
  bristles_.Step(d, load_state_.data(), level, bristle_.data());

  double* next = next_.data();
  const bool senses = !bound_.sensors().empty();
  for (size_t i = 0, count = joints.size(); i < count; ++i) {
    const JointFriction& friction = joints[i].friction;
    FrictionStep step = friction.own_bristle()
                            ? friction.Step(now_[i], motion_[i])
                            : friction.Complete(now_[i], motion_[i], bristle_[i]);
    if (step.feeds_itself) [[unlikely]]
      Report(m, d, joints[i]);

    // a speed without bound must not stay in the heat
    const double sum = step.force + step.next.bristle + step.next.energy + step.next.second_energy;
    if (!std::isfinite(sum)) [[unlikely]] {
      step.force = 0;
      step.next = now_[i];
    }
    force_[i] = step.force;
    friction.Store(step.next, next);
    next += friction.state().size();
    if (senses) NoteSensed(i, step);
  }
  if (!senses_) return;
  senses_ = false;
  WriteSensors(m, d);
}

void FrictionInstance::NoteSensed(size_t i, const FrictionStep& step) {
  const double energy = now_[i].energy + now_[i].second_energy;
  const double per_temperature = bound_.joints()[i].friction.level_per_temperature();
  const double rise = per_temperature != 0 ? energy / per_temperature : 0;
  const double held = step.sliding ? 0 : 1;
  double* sensed = sensed_.data() + kSensed * i;
  for (const double value : {-step.force, energy, rise, step.loss, held}) *sensed++ = value;
}

void FrictionInstance::StepActuators(const mjModel* m, mjData* d) {
  Prepare(m, d);
  const double rate = m->opt.integrator == mjINT_RK4 ? 0 : 1 / timestep_;
  const bool starts = d->plugin_state[m->plugin_stateadr[instance_] + kStartsWarm] != 0;
  for (size_t i = 0; i < now_.size(); ++i) {
    const BoundJoint& joint = bound_.joints()[i];
    if (joint.needs_ambient) motion_[i].ambient_rise = Finite(d->ctrl[joint.control]);
    FrictionState& now = now_[i] = joint.friction.Load(d->act + joint.state);
    if (starts && now.energy == 0 && now.second_energy == 0) {
      now.energy = joint.initial_energy[0];
      now.second_energy = joint.initial_energy[1];
    }
  }
  StepJoints(m, d);

  const double* next = next_.data();
  for (const BoundJoint& joint : bound_.joints()) {
    const mjtNum* act = d->act + joint.state;
    mjtNum* act_dot = d->act_dot + joint.state;
    for (size_t k = joint.friction.state().size(); k > 0; --k) {
      *act_dot++ = (*next++ - *act++) * rate;
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
  for (size_t i = 0; i < now_.size(); ++i) {
    const BoundJoint& joint = bound_.joints()[i];
    now_[i] = joint.friction.Load(d->plugin_state + joint.state);
    motion_[i].ambient_rise = ambient;
  }
  StepJoints(m, d);
  // the engine clears the forces of trees that are awake alone
  const bool sleeps = m->opt.enableflags & mjENBL_SLEEP;
  for (size_t i = 0; i < force_.size(); ++i) {
    const int dof = bound_.joints()[i].dof;
    if (sleeps && d->tree_asleep[m->dof_treeid[dof]] >= 0) continue;
    d->qfrc_passive[dof] -= force_[i];
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
  senses_ = !off;
  if (!off) return;
  std::fill(sensed_.begin(), sensed_.end(), 0.0);
  WriteSensors(m, d);
}

void FrictionInstance::WriteSensors(const mjModel* m, mjData* d) const {
  for (const int sensor : bound_.sensors()) {
    mjtNum* data = d->sensordata + m->sensor_adr[sensor];
    std::copy(sensed_.begin(), sensed_.end(), data);

    // the engine clips what stands there at the stage of positions
    const double most = m->sensor_cutoff[sensor];
    if (most <= 0) continue;
    for (size_t i = 0; i < sensed_.size(); ++i) data[i] = std::clamp(data[i], -most, most);
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
