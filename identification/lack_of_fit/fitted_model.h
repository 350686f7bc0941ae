// The model that a fit holds, over the recording that it was fitted to.
#pragma once

#include <warmjoint/prepared_log.h>

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "identification/forward/closed_loop.h"
#include "identification/inference/inference.h"

namespace warmjoint {

struct FittedModel {
  Selection selection;          // samples that were fitted
  double step = 0;              // of the log, median, s
  Eigen::VectorXd torque;       // [N] tau less gravity, inertia and what a lag adds, N.m or N
  Eigen::VectorXd residual;     // [N] `torque` less F, N.m or N
  Eigen::MatrixXd derivatives;  // [N x (p + J)] dF/dx at the estimate; dF/db of the jumps b that
                                // E makes at gaps, and at further starts if fitted (gaps.h)
  Eigen::MatrixXd cold;  // [N x d] dFn/dp, by the parameters of law and load without their heat
  Eigen::Index of_friction = 0;  // the first so many of x are law, heat and start
  std::vector<size_t> rows;      // [p] of x, in the fit's table: parameters of law and load, then
                                 // those estimated of heat, start, gravity, inertia
  Eigen::MatrixXd
      by_initial_energy;        // [N x s] dF/dE(0) of the recordings where it is taken to be known
  Eigen::VectorXd energy;       // [N] E, N.m or N
  Eigen::VectorXd jump_spread;  // [J] how much E may jump at the gaps, N.m or N
  /// [N] ForceOfHeldLoss, N.m or N, where the step of the log matters to the warming.
  std::optional<Eigen::VectorXd> held_loss;
  Eigen::MatrixXd
      weight;  // [N x 2] sin and cos of the position, where a weight may act that the fit leaves out; else [N x 0]
  Eigen::MatrixXd rigid;  // [N x r] columns of the fit's gravity, as a sine, and of its inertia
  std::optional<Eigen::VectorXd> maps;  // [N] torque of the maps, N.m or N, where there are any
  std::vector<MapQuantity> mapped;      // the quantities that the maps are over

  std::optional<Thermal> thermal;  // where a warming was estimated
  /// where a warming was estimated: that of the law's parameters
  std::shared_ptr<const ClosedLoop> loop;
  bool has_bristle = false;  // whether the law has a state of its own, by which the joint sticks
};

/// Whether a fit has a field of that kind.
inline bool HasField(const Fit& fit, FieldKind kind) {
  return fit.figures.fields && fit.figures.fields->present.Has(kind);
}

/// dFn/dp of a law at speeds, by central differences where it is not linear in p. values: [d] p; velocity: [N] rad/s or m/s;
/// returns [N x d]
Eigen::MatrixXd NominalDerivatives(const Law& law, const std::vector<double>& values,
                                   const Eigen::VectorXd& velocity);

/// The same of a fit whose friction may grow with the load, by load_gain, too. load: [N] |load|, N.m or N, which is read where it does;
/// returns [N x d] or [N x d + 1]
Eigen::MatrixXd NominalDerivatives(const Fit& fit, const Eigen::VectorXd& velocity,
                                   const std::optional<Eigen::VectorXd>& load);

/// Nothing where the fit was refused. inference: of the fit; selection: samples at constant speed.
std::optional<FittedModel> EvaluateModel(const Fit& fit, const Inference& inference,
                                         const LogSamples& measurements,
                                         const Selection& selection);

/// The force that (22) leaves out: that of a friction whose losses follow its heat all the time, less
/// the force by (22). It is 8/7 of the difference that (22) with steps of an eighth makes. The speed is constant over
/// each step. Returns [N] N.m or N.
Eigen::VectorXd ForceOfHeldLoss(const Friction& friction, const LogSamples& measurements,
                                const ThermalStart& start = {});

}  // namespace warmjoint
