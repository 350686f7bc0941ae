// Law, maps and heat as one least-squares problem.
#pragma once

#include <Eigen/Core>

#include "identification/maps/map_blocks.h"
#include "identification/maps/map_fit.h"
#include "identification/model/conditions.h"
#include "identification/model/minimise.h"
#include "identification/model/model_squares.h"
#include "identification/uncertainty/uncertainty.h"

namespace warmjoint {

/// argmin |y - f(x)|^2 + s w^T P w + what was known of the heat, f the force of law, maps, heat, gravity and inertia over the closed
/// loop, under the conditions that separate law and maps (map_fit.h). Unknowns: law, rigid part, weights, heat, start, jumps.
class WarmMapFit {
 public:
  /// Shapes, strength and what is known of the heat are those of the blocks; input: must outlive this.
  WarmMapFit(const IdentifierInput& input, const MapTask& task, const MapBlock& block,
             const WarmingBlock& warming);
  WarmMapFit(const WarmMapFit&) = delete;
  WarmMapFit& operator=(const WarmMapFit&) = delete;

  /// Minimises from the block's latest fit on, and gives it law, weights and E. False where nothing can be solved.
  bool Refine(MapBlock& block);

  bool converged() const { return converged_; }
  int iterations() const { return iterations_; }
  /// The places of unknowns with a role; law, rigid part (gravity), weights, heat, start and jumps in this order.
  Slice At(Role role) const { return model_.At(role); }
  /// dE/dx at the end of the log. [p]
  Eigen::VectorXd EndSlopes() const { return ModelAt(model_, x_).End().slopes; }
  /// Writes the heat that the fit estimates into `warming`.
  void HeatInto(ThermalFit& warming) const;
  /// The uncertainty of all unknowns (uncertainty.h). maps: the block's; residual: [n] that is left, N.m or N
  Uncertainty CovarianceOf(const MapFit& maps, const Eigen::VectorXd& residual);

 private:
  /// From x_ on under conditions.
  void MinimiseUnder(const Conditions& conditions);

  const Selection& selection_;
  double variance_;  // about that of the noise, (N.m)^2 or N^2
  Model model_;      // with the prior of the weights as one of a group
  ModelSamples samples_;
  ModelSquares squares_;
  Eigen::VectorXd x_;  // [p]
  bool converged_ = false;
  int iterations_ = 0;
};

}  // namespace warmjoint
