#include "sim/plugin/joint_rows.h"

#include <algorithm>
#include <cmath>

#include "sim/plugin/check_joint.h"

namespace warmjoint::inline sim {

JointRows::JointRows(const mjModel* m, const std::vector<BoundJoint>& joints) {
  std::vector<CoupledJoint> coupled;
  std::vector<bool> is_coupled(joints.size());
  for (size_t i = 0; i < joints.size(); ++i) {
    const BoundJoint& joint = joints[i];
    const double inertia = EffectiveInertia(m, joint.dof);
    // before the compiler knows the inertia, nothing is held
    is_coupled[i] = !joint.friction.own_bristle() && inertia > 0;
    if (!is_coupled[i]) continue;
    coupled.push_back(
        {joint.dof, inertia, joint.instances, !joint.friction.level_follows_heat_alone()});
  }
  bristles_ = CoupledBristles(m, coupled);
  size_t rows = bristles_.size();
  int states = 0;
  joint_at_.assign(rows, 0);
  for (size_t i = 0; i < joints.size(); ++i) {
    const BoundJoint& joint = joints[i];
    const size_t row = is_coupled[i] ? bristles_.RowOf(joint.dof) : rows++;
    const size_t own_states = joint.friction.state().size();
    at_.push_back({PlaceOf(row), joint.dof, joint.state, states, own_states == 2});
    if (is_coupled[i]) joint_at_[row] = i;
    if (joint.friction.own_bristle()) alone_.push_back(i);
    states += static_cast<int>(own_states);
  }
  next_.assign(static_cast<size_t>(states), 0);
  FindTwos();
  numbers_.assign(NumbersOf(rows), 0);
  for (const CoupledJoint& joint : coupled) {
    const size_t i = joint_at_[bristles_.RowOf(joint.dof)];
    Of(i, kInertia) = joint.inertia;
    Of(i, kPerInertia) = 1 / joint.inertia;
  }
  pushed_.reserve(joints.size());
}

void JointRows::ReadNumbers(const mjModel* m, const std::vector<BoundJoint>& joints) {
  for (size_t i = 0; i < joints.size(); ++i) {
    const JointFriction& friction = joints[i].friction;
    const Heat& heat = friction.heat();
    Of(i, kUpperAtRest) = friction.OwnLevelAtRest(1);
    Of(i, kLowerAtRest) = friction.OwnLevelAtRest(-1);
    Of(i, kSlope) = friction.viscous();
    Of(i, kPerEnergy) = friction.viscous_per_energy();
    Of(i, kPole) = heat.first.pole;
    Of(i, kGain) = heat.first.gain;
    Of(i, kAmbientGain) = heat.ambient_gain;
    Of(i, kSecondPole) = heat.second.pole;
    Of(i, kSecondGain) = heat.second.gain;
  }
  const double damping = m->opt.integrator == mjINT_RK4 ? kDampingOfStages : 1;
  bristles_.SetTimestep(m->opt.timestep, damping, [&](int dof) {
    return joints[joint_at_[bristles_.RowOf(dof)]].friction.SteepestSlope();
  });
}

/// Joints that are neighbours, and have the same two states, are loaded and stored together.
void JointRows::FindTwos() {
  for (size_t i = 0; i < at_.size(); ++i) {
    const bool first = at_[i].place % (2 * kColumns) == 0;
    const bool two = first && i + 1 < at_.size() && at_[i + 1].place == at_[i].place + 1;
    if (two && at_[i].plain && at_[i + 1].plain) {
      twos_.push_back({at_[i], at_[i + 1]});
      ++i;
    } else {
      ones_.push_back(i);
    }
  }
}

void JointRows::Load(const mjData* d, const std::vector<BoundJoint>& joints, const mjtNum* states) {
  d_ = d;
  joints_ = joints.data();
  states_ = states;
  Two finite = Two::Zero();
  for (const auto& [a, b] : twos_) {
    const RowPair row{numbers_.data() + a.place};
    const mjtNum *one = states + a.state, *other = states + b.state;
    const Two load{one[0], other[0]}, first{one[1], other[1]}, sum = load + first;
    row[kSpeed] = Two{d->qvel[a.dof], d->qvel[b.dof]};
    row[kLoad] = load;
    row[kFirst] = first;
    finite += sum - sum;
  }
  for (const size_t i : ones_) LoadOne(i);

  // a sum is finite only where all of its terms are
  if (finite[0] == 0 && finite[1] == 0) [[likely]]
    return;
  for (size_t i = 0; i < at_.size(); ++i) LoadOne(i);
}

void JointRows::LoadOne(size_t i) {
  const FrictionState state = joints_[i].friction.Load(states_ + at_[i].state);
  Of(i, kSpeed) = d_->qvel[at_[i].dof];
  Of(i, kLoad) = state.bristle;
  Of(i, kFirst) = state.energy;
  Of(i, kSecond) = state.second_energy;
}

void JointRows::Step(const mjModel* m, const mjtNum* load) {
  load_ = load;
  pushed_.clear();
  SetLevels();
  bristles_.Step(d_, *this, {numbers_.data()});
  Complete();
  if (!alone_.empty()) StepAlone(m);
  Store();
}

/// The levels of joints for which heat alone changes them; of others about those, for a guess.
void JointRows::SetLevels() {
  double* const end = numbers_.data() + numbers_.size();
  for (RowPair row{numbers_.data()}; row.numbers != end; row.numbers += 2 * kColumns) {
    const Two energy = row[kFirst] + row[kSecond];
    row[kUpper] = (row[kUpperAtRest] + energy).max(0);
    row[kLower] = (row[kLowerAtRest] + energy).max(0);
  }
}

/// The level of one side where more than heat changes it.
double JointRows::LevelAt(size_t row, int side) const {
  const size_t i = joint_at_[row];
  FrictionState state;
  if (at_[i].plain) {
    state.energy = Of(i, kFirst);
  } else {
    state = StateOf(i);
  }
  return joints_[i].friction.Level(side, state, MotionOf(i));
}

/// The state with which the step began.
FrictionState JointRows::StateOf(size_t i) const {
  FrictionState state = joints_[i].friction.Load(states_ + joints_[i].state);
  state.energy = Of(i, kFirst);
  state.second_energy = Of(i, kSecond);
  return state;
}

JointMotion JointRows::MotionOf(size_t i) const {
  const BoundJoint& joint = joints_[i];
  JointMotion motion;
  motion.position = d_->qpos[joint.position];
  motion.velocity = Of(i, kSpeed);
  if (joint.needs_load) motion.load = load_[joint.dof];
  motion.ambient_rise = Of(i, kRise);
  return motion;
}

/// The rest of each row's step, its bristle being known: JointFriction::Complete for all.
void JointRows::Complete() {
  double* const end = numbers_.data() + numbers_.size();
  for (RowPair row{numbers_.data()}; row.numbers != end; row.numbers += 2 * kColumns) {
    const Two first = row[kFirst], second = row[kSecond], v = row[kSpeed], f = row[kFriction];
    const Two viscous = (row[kSlope] + row[kPerEnergy] * (first + second)).max(0) * v;
    const Two loss = viscous * v + row[kSliding] * (f * v).abs();
    row[kLoss] = loss;
    row[kForce] = viscous + f;
    row[kNextFirst] = row[kPole] * first + row[kGain] * loss + row[kAmbientGain] * row[kRise];
    row[kNextSecond] = row[kSecondPole] * second + row[kSecondGain] * loss;
  }
}

/// Joints whose bristle is their own law's.
void JointRows::StepAlone(const mjModel* m) {
  for (const size_t i : alone_) {
    JointMotion motion = MotionOf(i);
    motion.inertia = EffectiveInertia(m, d_, joints_[i].dof);
    Take(i, joints_[i].friction.Step(StateOf(i), motion));
  }
}

void JointRows::Take(size_t i, const FrictionStep& step) {
  Of(i, kForce) = step.force;
  Of(i, kLoss) = step.loss;
  Of(i, kLoad) = step.next.bristle;
  Of(i, kSliding) = step.sliding;
  Of(i, kNextFirst) = step.next.energy;
  Of(i, kNextSecond) = step.next.second_energy;
  if (step.feeds_itself) pushed_.push_back(i);
}

/// Friction without a force may be one that would push.
void JointRows::TakeDeficit(size_t i) {
  if (joints_[i].friction.own_bristle()) return;
  const BristleStep bristle{0, Of(i, kLoad), Of(i, kSliding) != 0};
  Take(i, joints_[i].friction.Complete(StateOf(i), MotionOf(i), bristle));
}

/// Stores the states of all joints.
void JointRows::Store() {
  for (size_t i = 0; i < at_.size(); ++i) {
    const Row row{numbers_.data() + at_[i].place};
    if (row[kFriction] == 0 && row[kSpeed] != 0) [[unlikely]]
      TakeDeficit(i);
  }
  double* const next = next_.data();
  Two finite = Two::Zero();
  for (const auto& [a, b] : twos_) {
    const RowPair row{numbers_.data() + a.place};
    const Two load = row[kLoad], first = row[kNextFirst], sum = row[kForce] + load + first;
    Two::Map(next + a.next) = Two{load[0], first[0]};
    Two::Map(next + b.next) = Two{load[1], first[1]};
    finite += sum - sum;
  }
  for (const size_t i : ones_) StoreOne(i);
  if (finite[0] == 0 && finite[1] == 0) [[likely]]
    return;
  for (size_t i = 0; i < at_.size(); ++i) StoreOne(i);
}

void JointRows::StoreOne(size_t i) {
  const double v = Of(i, kSpeed);
  FrictionState state{Of(i, kLoad), Of(i, kNextFirst), Of(i, kNextSecond),
                      Of(i, kSliding) != 0 ? static_cast<double>(Sign(v)) : 0.0};

  // a speed without bound must not stay in the heat
  double& force = Of(i, kForce);
  const double sum = force + state.bristle + state.energy + state.second_energy;
  if (sum - sum != 0) [[unlikely]] {
    force = 0;
    state = StateOf(i);
  }
  joints_[i].friction.Store(state, next_.data() + at_[i].next);
}

}  // namespace warmjoint::inline sim
