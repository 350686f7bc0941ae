// How parameters move with forces that a fit leaves out.
#pragma once

#include <Eigen/Core>

#include "identification/lack_of_fit/bins.h"
#include "identification/lack_of_fit/circumstances.h"
#include "identification/lack_of_fit/examine.h"
#include "identification/lack_of_fit/fitted_model.h"

namespace warmjoint {

/// Omitted-variable bias with its sign turned: the change of x once a force f, N.m or N, is known,
/// -(J^T W J)^-1 J^T W f. J is taken apart once for all forces.
class ForceMoves {
 public:
  /// derivatives: J [m x p]
  ForceMoves(const Bins& bins, const Eigen::MatrixXd& derivatives);

  /// forces: [m x q]; returns [p x q].
  Eigen::MatrixXd By(const Eigen::MatrixXd& forces) const;

  /// Of the rows of J times the root of their weight. [m x r]
  const Eigen::MatrixXd& basis() const { return basis_; }
  /// Whether no parameter is a mix of the others.
  bool AllApart() const { return basis_.cols() == mix_.rows(); }
  /// [m] of the weights
  const Eigen::VectorXd& root() const { return root_; }

 private:
  Eigen::VectorXd root_;
  Eigen::MatrixXd basis_;
  Eigen::MatrixXd mix_;  // [p x r] basis = root J mix
};

/// How far changes of a fit's parameters change the friction of law and heat.
class FrictionChange {
 public:
  /// derivatives: DerivativesOver; friction: rms of law and heat over the kept samples, N.m or N.
  FrictionChange(const FittedModel& model, const Bins& bins, const Eigen::MatrixXd& derivatives,
                 double friction);

  /// The largest of three, rms over the kept samples as a share of the friction's: the change along
  /// the log J d, that of the cold curve dFn/dp d, and that of what heat takes off it, the
  /// difference of both. d: [p]
  double By(const Eigen::VectorXd& changes) const;

 private:
  Eigen::VectorXd root_;  // [m] of the weights, over the friction's rms and the root of the samples
  Eigen::MatrixXd warm_;  // [m x q] dF/dx by law, heat and start
  Eigen::MatrixXd cold_;  // [m x d] dFn/dp
};

/// Of the parameters, of the jumps at gaps, and of heat within the steps where that matters (held_loss.h), over
/// bins. [m x (p + ...)]
Eigen::MatrixXd DerivativesOver(const Bins& bins, const FittedModel& model);

/// Adds the row held_losses where the step of the log matters to the warming (held_loss.h): the parameters of heat that is
/// followed within the steps where the residual tells that it is, an interval that covers both where it cannot tell; no row where
/// it tells that losses are held. derivatives: DerivativesOver.
void AddHeldLosses(const FittedModel& model, const Bins& bins, Eigen::Index p,
                   const Eigen::MatrixXd& derivatives, Examination& examination);

/// Adds the rows cold_start, slow_drift, dead_band and gaps. derivatives: DerivativesOver; moves: by them.
void AddAssumptions(const Fit& fit, const FittedModel& model, const Bins& bins,
                    const Circumstances& known, Eigen::Index p, const Eigen::MatrixXd& derivatives,
                    const ForceMoves& moves, Examination& examination);

}  // namespace warmjoint
