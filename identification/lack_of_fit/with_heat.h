// What forces that a fit leaves out do once they make heat, too.
#pragma once

#include <Eigen/Core>

#include "identification/lack_of_fit/fitted_model.h"
#include "models/recording/measurements.h"

namespace warmjoint::inline identification {

/// dF/dc at c = 0 of a friction that holds c f beside the fit's: f itself, and what its losses change of E
/// (closed_loop.h); f where no warming was estimated. forces: f, [N x q] N.m or N; at_losses: the same at the
/// velocity of the losses, for recordings that tell it; empty: the same. Returns [N x q].
Eigen::MatrixXd WithHeat(const FittedModel& model, const Measurements& measurements,
                         const Eigen::MatrixXd& forces, const Eigen::MatrixXd& at_losses = {});

}  // namespace warmjoint::inline identification
