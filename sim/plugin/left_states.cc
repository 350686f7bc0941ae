#include "sim/plugin/left_states.h"

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

bool LeftStates::Keep(const mjtNum* states, double time) {
  time_ = time;
  Two finite = Two::Zero();
  double* const left = left_.data();
  for (const StateRun run : runs_) {
    ByTwos(run, [&]<typename Numbers>(const Numbers&, int k) {
      const Numbers now = Numbers::Map(states + run.begin + k);
      Numbers::Map(left + run.next + k) = now;
      finite.head<Numbers::SizeAtCompileTime>() += now - now;
    });
  }
  // a difference from itself is 0 for finite numbers alone
  return finite[0] == 0 && finite[1] == 0;
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

void LeftStates::FindRates(const std::vector<double>& next, const mjtNum* states, double per_second,
                           mjtNum* rates) const {
  const double* const to = next.data();
  for (const StateRun run : runs_) {
    ByTwos(run, [&]<typename Numbers>(const Numbers&, int k) {
      const Numbers now = Numbers::Map(states + run.begin + k);
      Numbers::Map(rates + run.begin + k) = (Numbers::Map(to + run.next + k) - now) * per_second;
    });
  }
}

}  // namespace warmjoint::inline sim
