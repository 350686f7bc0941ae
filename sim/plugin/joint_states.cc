#include "sim/plugin/joint_states.h"

#include <algorithm>
#include <cstring>

#include "sim/plugin/row_pairs.h"

namespace warmjoint {
namespace {

using One = Eigen::Array<double, 1, 1>;

/// Visits a run's states two by two, and one that is left over: visit(two or one, place in the run).
template <typename Visit>
void ByTwos(const StateRun run, const Visit& visit) {
  const int last = run.states - 1;
  for (int k = 0; k < last; k += 2) visit(Two(), k);
  if (last % 2 == 0) visit(One(), last);
}

}  // namespace

JointStates::JointStates(const std::vector<BoundJoint>& joints, const std::vector<size_t>& places) {
  int next = 0;
  // states of joints stand beside each other, in the order of joints
  for (size_t i = 0; i < joints.size(); ++i) {
    const auto own = static_cast<int>(joints[i].friction.state().size());
    at_.push_back({places[i], joints[i].dof, joints[i].state, next, joints[i].output, own == 2});
    next += own;
  }
  next_.assign(static_cast<size_t>(next), 0);
  FindTwos();
}

/// Joints that follow each other, and have the same two states, are loaded and stored together.
void JointStates::FindTwos() {
  // two plain joints of a pair of rows, which are neighbours in the model as well
  for (size_t i = 0; i < at_.size(); ++i) {
    const At& at = at_[i];
    const auto follows = [&](const At& next) {
      return next.plain && next.place == at.place + 1 && next.dof == at.dof + 1 &&
             next.state == at.state + 2 && (next.output < 0 || next.output == at.output + 1);
    };
    const bool first = at.plain && at.place % (2 * kColumns) == 0;
    if (first && i + 1 < at_.size() && follows(at_[i + 1])) {
      twos_.push_back(at);
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

  // two joints at a time, then those that are left
  Two finite = Two::Zero();
  for (const At& at : twos_) {
    const RowPair row{rows + at.place};
    const mjtNum* state = states + at.state;
    const Two load{state[0], state[2]}, first{state[1], state[3]}, sum = load + first;
    row[kSpeed] = Two::Map(d->qvel + at.dof);
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

void JointStates::TakeForces(const double* rows, mjtNum* forces) const {
  for (const At& at : twos_) {
    Two::Map(forces + at.dof) -= Two::Map(rows + at.place + 2 * kForce);
  }
  for (const size_t i : ones_) forces[at_[i].dof] -= rows[at_[i].place + 2 * kForce];
}

void JointStates::GiveForces(const double* rows, mjtNum* outputs) const {
  for (const At& at : twos_) {
    Two::Map(outputs + at.output) = -Two::Map(rows + at.place + 2 * kForce);
  }
  for (const size_t i : ones_) outputs[at_[i].output] = -rows[at_[i].place + 2 * kForce];
}

void JointStates::Store(double* rows) {
  double* const next = next_.data();
  Two finite = Two::Zero();
  // two joints at a time, then those that are left
  for (const At& at : twos_) {
    const RowPair row{rows + at.place};
    const Two load = row[kLoad], first = row[kNextFirst], sum = row[kForce] + load + first;
    Two::Map(next + at.next) = Two{load[0], first[0]};
    Two::Map(next + at.next + 2) = Two{load[1], first[1]};
    finite += sum - sum;
  }
  for (const size_t i : ones_) StoreOne(i, rows);

  // one by one where any number is not finite
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

LeftStates::LeftStates(const std::vector<BoundJoint>& joints) {
  int next = 0;
  for (const BoundJoint& joint : joints) {
    const auto states = static_cast<int>(joint.friction.state().size());
    const bool goes_on = !runs_.empty() && runs_.back().begin + runs_.back().states == joint.state;
    if (goes_on) {
      runs_.back().states += states;
    } else {
      runs_.push_back({joint.state, next, states});
    }
    next += states;
  }
  left_.assign(static_cast<size_t>(next), 0);
}

bool LeftStates::Match(const mjtNum* states, double time) const {
  bool same = time == time_;
  for (const StateRun& run : runs_) {
    const size_t bytes = static_cast<size_t>(run.states) * sizeof(mjtNum);
    same = same && std::memcmp(states + run.begin, left_.data() + run.next, bytes) == 0;
  }
  return same;
}

void LeftStates::Keep(const mjtNum* states, double time) {
  time_ = time;
  for (const StateRun& run : runs_) {
    std::copy_n(states + run.begin, run.states, left_.begin() + run.next);
  }
}

void LeftStates::Put(const std::vector<double>& next, mjtNum* states, double time) {
  time_ = time;
  const double* const from = next.data();
  double* const left = left_.data();
  for (const StateRun run : runs_) {
    ByTwos(run, [&]<typename Numbers>(const Numbers&, int k) {
      const Numbers now = Numbers::Map(from + run.next + k);
      Numbers::Map(left + run.next + k) = now;
      Numbers::Map(states + run.begin + k) = now;
    });
  }
}

bool LeftStates::FindRates(const std::vector<double>& next, const mjtNum* act, double h,
                           mjtNum* act_dot) {
  const double per_second = 1 / h;
  const double* const to = next.data();
  double* const left = left_.data();
  Two finite = Two::Zero();
  for (const StateRun run : runs_) {
    ByTwos(run, [&]<typename Numbers>(const Numbers&, int k) {
      const Numbers now = Numbers::Map(act + run.begin + k);
      const Numbers rate = (Numbers::Map(to + run.next + k) - now) * per_second;
      Numbers::Map(act_dot + run.begin + k) = rate;
      Numbers::Map(left + run.next + k) = now + rate * h;
      finite.head<Numbers::SizeAtCompileTime>() += rate - rate;
    });
  }
  // a difference from itself is 0 for finite numbers alone
  return finite[0] == 0 && finite[1] == 0;
}

}  // namespace warmjoint
