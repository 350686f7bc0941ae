// Whether a log shows that its torque lags.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "identification/lagged/lagged_rows.h"

namespace warmjoint {

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
