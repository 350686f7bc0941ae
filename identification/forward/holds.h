// What inner loops over a log's heat do over one interval.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/friction/intervals.h"
#include "models/friction/thermal.h"

namespace warmjoint {

/// Eq. (22) over one interval where the loss follows E itself, W = |v| (g p + E): ThermalStep of the
/// level g p alone, with the gain ke |v| and the pole te + ke |v|. One product and one sum lead from
/// each E to its next, so that the chain of dependent operations is short.
/// speed: |v|, rad/s or m/s.
inline DiscreteThermal FedBack(const IntervalHold& hold, double speed) {
  const double gain = hold.gain * speed;
  return {gain, hold.pole + gain};
}

/// Calls run(hold_after) with the hold that follows each sample n, hold_after(n): one for all, or one of a table.
template <typename Run>
void WithHolds(const Intervals& intervals, const Thermal& thermal, Run&& run) {
  const std::vector<IntervalHold> holds = Holds(intervals, thermal);
  if (intervals.even()) {
    run([hold = holds[0]](Eigen::Index) -> const IntervalHold& { return hold; });
  } else {
    run([&](Eigen::Index n) -> const IntervalHold& { return holds[intervals.which[n]]; });
  }
}

}  // namespace warmjoint
