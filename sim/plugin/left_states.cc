#include "sim/plugin/left_states.h"

#include <algorithm>
#include <cstring>

#include "sim/plugin/row_pairs.h"

namespace warmjoint::inline sim {
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

}  // namespace warmjoint::inline sim
