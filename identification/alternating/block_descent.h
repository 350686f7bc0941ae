// The loop of Algorithm 1: energy and nominal friction fitted in turn.
#pragma once

#include <Eigen/Core>

#include "identification/alternating/output_error.h"

namespace warmjoint {

/// Where the loop stands.
struct DescentState {
  Eigen::VectorXd nominal;  // [d] parameters of Fn
  Thermal thermal;
  double rmse = 0;     // of tau - Fn - sign(v) E over the kept samples, N.m or N
  bool inside = true;  // the time constant lies within the bounds of OutputError
};

/// Algorithm 1 of the paper, on samples with losses W = |(tau - G) v| (19). Only samples that are
/// kept and move take part in the fits of (22) and (24); the filter runs over all.
class BlockDescent {
 public:
  /// columns: [N x d] regressor of Fn + G over all samples; cofactor: [d x d] (A^T A)^-1 of the
  /// kept moving ones, with the prior's strength where there are kernels; gravity: [N] G, which
  /// makes no heat, N.m or N.
  BlockDescent(const Measurements& measurements, const Selection& moving,
               const Eigen::MatrixXd& columns, const Eigen::MatrixXd& cofactor,
               const Eigen::VectorXd& gravity);

  /// Iteration 0: E = H0 W, then Fn by (24). H0 acts first, because a start from plain least
  /// squares would throw it away.
  DescentState Start(const Thermal& start) const;

  /// One iteration from `state`: E by (23), H by output error, E = H W, Fn by (24).
  DescentState Next(const DescentState& state) const;

  /// The time constant from which the first fit of H starts, s: the best one on a grid.
  double ScanFrom(const DescentState& state) const;

  /// sign(v) E over all samples, 0 where not kept. [N] N.m or N.
  Eigen::VectorXd Warming(const Thermal& thermal) const;

  /// Fitted torque Fn + sign(v) E over all samples, 0 where not kept. [N] N.m or N.
  Eigen::VectorXd Fitted(const DescentState& state) const;

  /// Derivatives of Fitted by (nominal, gain, ln tau). [N x (d + 2)], 0 where not kept.
  Eigen::MatrixXd Jacobian(const DescentState& state) const;

  const OutputError& output_error() const { return output_error_; }

 private:
  Eigen::VectorXd MeasuredEnergy(const Eigen::VectorXd& nominal) const;
  DescentState WithNominal(const Thermal& thermal, bool inside) const;

  // rows of samples that are not kept, or do not move, are 0
  Eigen::VectorXd sign_;     // [N]
  Eigen::VectorXd torque_;   // [N] N.m or N
  Eigen::MatrixXd columns_;  // [N x d]
  Eigen::MatrixXd cofactor_;
  OutputError output_error_;
  double kept_;
};

}  // namespace warmjoint
