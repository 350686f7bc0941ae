// The time constant of a lag that leaves the least squares.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "identification/lagged/kept_runs.h"

namespace warmjoint {

/// How many time constants, the same ratio apart, are tried before the best is refined.
inline constexpr int kLagsTried = 14;

/// Time constants between which a lag can be told, s: from an eighth of a sampling interval, whose
/// e^-8 no sample shows, to the duration of a run, beyond which what it holds looks like a drift of the run.
struct LagRange {
  double shortest = 0;
  double longest = 0;

  /// kLagsTried of them, the shortest first.
  std::vector<double> Tried() const;
  /// Whether a lag lies within and at neither end.
  bool Holds(double lag) const { return lag > 1.01 * shortest && lag < 0.99 * longest; }
};

LagRange LagsOf(const KeptRuns& runs);

/// The time constant of the least squares: the best of kLagsTried, refined between its neighbours by
/// Brent's method (1973) to 1e-6 of itself. squares: of the fit at a time constant; infinite where it
/// has none. Nothing where every fit fails or the best lies at an end of the range.
std::optional<double> FindLag(const LagRange& range, const std::function<double(double)>& squares);

}  // namespace warmjoint
