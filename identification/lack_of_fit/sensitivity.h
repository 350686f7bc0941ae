// How parameters move with forces that a fit leaves out.
#pragma once

#include <Eigen/Core>

#include "identification/lack_of_fit/bins.h"
#include "identification/lack_of_fit/examine.h"
#include "identification/lack_of_fit/fitted_model.h"

namespace warmjoint::inline identification {

/// Omitted-variable bias with its sign turned: the change of x once each force, N.m or N, is known,
/// -(J^T W J)^-1 J^T W f. derivatives: J [m x p]; forces: [m x q]; returns [p x q].
Eigen::MatrixXd MovesBy(const Eigen::MatrixXd& forces, const Bins& bins,
                        const Eigen::MatrixXd& derivatives);

/// Of the parameters, of the jumps at gaps, and of heat within the steps where that matters (held_loss.h), over
/// bins. [m x (p + ...)]
Eigen::MatrixXd DerivativesOver(const Bins& bins, const FittedModel& model);

/// Fills what the examination knows of heat within the steps: its moves, and whether the residual tells that it is
/// there. derivatives: DerivativesOver.
void LearnHeat(const FittedModel& model, const Bins& bins, Eigen::Index p,
               const Eigen::MatrixXd& derivatives, Examination& examination);

/// Fills the moves by start, slow drift and gaps. derivatives: DerivativesOver.
void LearnAssumptions(const Fit& fit, const FittedModel& model, const Bins& bins, Eigen::Index p,
                      const Eigen::MatrixXd& derivatives, Examination& examination);

}  // namespace warmjoint::inline identification
