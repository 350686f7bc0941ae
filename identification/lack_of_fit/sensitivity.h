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

/// Fills what the examination knows of heat within the steps (held_loss.h): its moves, and whether
/// the residual tells that it is there. Its force joins the derivatives, [m x (p + ...)].
void LearnHeat(const FittedModel& model, const Bins& bins, Eigen::Index p,
               Eigen::MatrixXd& derivatives, Examination& examination);

/// Fills the moves by start, slow drift and gaps. derivatives: as LearnHeat leaves them.
void LearnAssumptions(const Fit& fit, const FittedModel& model, const Bins& bins, Eigen::Index p,
                      const Eigen::MatrixXd& derivatives, Examination& examination);

}  // namespace warmjoint::inline identification
