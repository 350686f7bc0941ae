#include "sim/plugin/joint_states.h"

namespace warmjoint::inline sim {

JointStates::JointStates(const std::vector<BoundJoint>& joints, const std::vector<size_t>& places) {
  int next = 0;
  for (size_t i = 0; i < joints.size(); ++i) {
    const auto own = static_cast<int>(joints[i].friction.state().size());
    at_.push_back({places[i], joints[i].dof, joints[i].state, next, own == 2});
    next += own;
  }
  next_.assign(static_cast<size_t>(next), 0);
  FindTwos();
}

/// Joints that are neighbours, and have the same two states, are loaded and stored together.
void JointStates::FindTwos() {
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

void JointStates::Load(const mjData* d, const std::vector<BoundJoint>& joints, const mjtNum* states,
                       double* rows) {
  d_ = d;
  joints_ = joints.data();
  states_ = states;
  Two finite = Two::Zero();
  for (const auto& [a, b] : twos_) {
    const RowPair row{rows + a.place};
    const mjtNum *one = states + a.state, *other = states + b.state;
    const Two load{one[0], other[0]}, first{one[1], other[1]}, sum = load + first;
    row[kSpeed] = Two{d->qvel[a.dof], d->qvel[b.dof]};
    row[kLoad] = load;
    row[kFirst] = first;
    finite += sum - sum;
  }
  for (const size_t i : ones_) LoadOne(i, rows);

  // a sum is finite only where all of its terms are
  if (finite[0] == 0 && finite[1] == 0) [[likely]]
    return;
  for (size_t i = 0; i < at_.size(); ++i) LoadOne(i, rows);
}

void JointStates::LoadOne(size_t i, double* rows) const {
  const FrictionState state = Before(i);
  const Row row{rows + at_[i].place};
  row[kSpeed] = d_->qvel[at_[i].dof];
  row[kLoad] = state.bristle;
  row[kFirst] = state.energy;
  row[kSecond] = state.second_energy;
}

void JointStates::Store(double* rows) {
  double* const next = next_.data();
  Two finite = Two::Zero();
  for (const auto& [a, b] : twos_) {
    const RowPair row{rows + a.place};
    const Two load = row[kLoad], first = row[kNextFirst], sum = row[kForce] + load + first;
    Two::Map(next + a.next) = Two{load[0], first[0]};
    Two::Map(next + b.next) = Two{load[1], first[1]};
    finite += sum - sum;
  }
  for (const size_t i : ones_) StoreOne(i, rows);
  if (finite[0] == 0 && finite[1] == 0) [[likely]]
    return;
  for (size_t i = 0; i < at_.size(); ++i) StoreOne(i, rows);
}

void JointStates::StoreOne(size_t i, double* rows) {
  const Row row{rows + at_[i].place};
  FrictionState state{row[kLoad], row[kNextFirst], row[kNextSecond],
                      row[kSliding] != 0 ? static_cast<double>(Sign(row[kSpeed])) : 0.0};

  // a speed without bound must not stay in the heat
  double& force = row[kForce];
  const double sum = force + state.bristle + state.energy + state.second_energy;
  if (sum - sum != 0) [[unlikely]] {
    force = 0;
    state = Before(i);
    state.energy = row[kFirst];
    state.second_energy = row[kSecond];
  }
  joints_[i].friction.Store(state, next_.data() + at_[i].next);
}

}  // namespace warmjoint::inline sim
