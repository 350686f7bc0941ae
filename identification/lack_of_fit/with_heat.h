// What forces that a fit leaves out do once they make heat, too.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "identification/forward/closed_loop_kernel.h"
#include "identification/lack_of_fit/bins.h"
#include "identification/lack_of_fit/fitted_model.h"
#include "models/friction/sign.h"

namespace warmjoint {

/// dF/dc at c = 0 of frictions that hold c s g beside the fit's, s = sign(v): s g itself, and what its losses change of E
/// (closed_loop.h); s g alone where no warming was estimated. levels(n, g): makes g of sample n, 4 F numbers in N.m or N;
/// at_losses(n, g): makes of it the same at the velocity of the losses. Returns means over bins, [m x 4 F]. Part of a
/// function for each processor (four.h).
template <std::size_t F, typename Levels, typename AtLosses>
inline Eigen::MatrixXd WithHeat(const FittedModel& model, const Eigen::VectorXd& velocity,
                                const Bins& bins, const Levels& levels, const AtLosses& at_losses) {
  if (!model.thermal) {
    return MeansOfRows<F>(bins, [&](Eigen::Index n, Fours<F>& row) {
      levels(n, row);
      for (Four& four : row) four *= static_cast<double>(Sign(velocity[n]));
    });
  }
  // by a force's own factor the loop is linear: its derivative is the same wherever the others are
  const ClosedLoop& loop = *model.loop;
  Eigen::MatrixXd means;
  WithHolds(loop.intervals(), *model.thermal, [&](const auto& hold_after) {
    Fours<F> S{};  // dE/dc
    means = MeansOfRows<F>(bins, [&](Eigen::Index n, Fours<F>& row) {
      Fours<F> g;
      levels(n, g);
      const double direction = loop.direction()[n];
      for (std::size_t k = 0; k < F; ++k) row[k] = direction * (g[k] + S[k]);
      // one step of Eq. (22); at rest nothing is lost
      at_losses(n, g);
      const auto [feedback, lambda] = FedBack(hold_after[n], loop.speed()[n]);
      const double gain = feedback * std::abs(direction);
      for (std::size_t k = 0; k < F; ++k) S[k] = lambda * S[k] + gain * g[k];
    });
  });
  return means;
}

}  // namespace warmjoint
