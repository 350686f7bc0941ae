// What forces that a fit leaves out do once they make heat, too.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "identification/forward/closed_loop_kernel.h"
#include "identification/lack_of_fit/bins.h"
#include "identification/lack_of_fit/fitted_model.h"

namespace warmjoint::inline identification {

/// Forces of C kinds, a sample after the other, [N x C] N.m or N.
template <int C>
using Forces = Eigen::Matrix<double, Eigen::Dynamic, C, C == 1 ? Eigen::ColMajor : Eigen::RowMajor>;

/// dF/dc at c = 0 of a friction that holds c f beside the fit's: f itself, and what its losses change of E
/// (closed_loop.h); f where no warming was estimated. forces: f; at_losses: the same at the velocity of the losses
/// where that is another. Returns means over bins, [m x C].
template <int C>
Eigen::MatrixXd WithHeat(const FittedModel& model, const Bins& bins, const Forces<C>& forces,
                         const Forces<C>& at_losses) {
  if (!model.thermal) return bins.Means(forces);
  // by a force's own factor the loop is linear: its derivative is the same wherever the others are
  const ClosedLoop& loop = *model.loop;
  BinMeans<C> means(bins);
  Eigen::Matrix<double, 1, C> S = Eigen::Matrix<double, 1, C>::Zero();  // dE/dc
  WithHolds(loop.intervals(), *model.thermal, [&](const auto& hold_after) {
    for (Eigen::Index n = 0; n < forces.rows(); ++n) {
      // at rest there is neither force nor loss
      const double direction = loop.direction()[n];
      means.Add(n, std::abs(direction) * forces.row(n) + direction * S);
      const auto [feedback, lambda] = FedBack(hold_after[n], loop.speed()[n]);
      S = lambda * S + (feedback * direction) * at_losses.row(n);
    }
  });
  return means.means();
}

}  // namespace warmjoint::inline identification
