// Whether a residual shows a lag, and the time constant of a lag that leaves the least squares.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "identification/lagged/lagged_rows.h"

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

/// What runs begin with, against what a lag would leave them.
struct SeenLag {
  double share = 0;  // of the drop of torque, what the runs begin with
  double p = 1;      // that so large a share is there by chance, of all time constants tried
  int runs = 0;      // that follow another one closely

  /// A lag leaves a share above 0, and not by chance: one log in a thousand.
  bool IsSeen() const { return share > 0 && p < 1e-3; }
};

/// Runs that follow another one within its duration: what they begin with, d of LaggedRows, over the
/// drop of the torque from the end of the run before to their own start, by least squares through the
/// origin. One number a run, so that neither the colour of the noise nor the rate counts; Student's t
/// with as many degrees of freedom as runs less one; Bonferroni over kLagsTried.
/// torque: [n] of the model, without lag; residual: [n] measured less L torque.
SeenLag LookForLag(const LaggedRows& rows, const Eigen::VectorXd& torque,
                   const Eigen::VectorXd& residual);

/// Whether the residual of a fit without lag shows one at any of the kLagsTried. torque, residual: [n]
bool ShowsLag(const std::shared_ptr<const KeptRuns>& runs, const Eigen::VectorXd& torque,
              const Eigen::VectorXd& residual);

}  // namespace warmjoint
