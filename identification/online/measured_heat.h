// The heat of measured losses, as a linear filter of the torque, and what noise does through it.
#pragma once

#include <warmjoint/recording.h>

#include <Eigen/Core>

#include "identification/forward/thermal_filter.h"

namespace warmjoint {

/// What a known warming takes off the torque, sign(v) E with E = H |F v|, Eqs. (19)-(22), where F is
/// the torque itself. Friction brakes, so that |F v| = F v, and the map
///     M: y -> sign(v) H (v y)
/// is linear. With the torque y = A p + sign(v) E + G x + e (law, heat, gravity, noise) and
/// F = y - G x - e,
///     (1 - M) y = A p + (1 - M) G x + (1 - M) e:
/// a regression on [A, (1 - M) G] whose noise is no longer e alone. M averages e over the time
/// constant: at each sample little, of standard deviation |k v| (h / 2 tau)^(1/2) that of e, but for
/// so long that it shifts a mean by as much as e itself. Weighted squares with the rows X, weights w
/// and C = (X^T W X)^-1 err by
///     C X^T W (1 - M) e = C B^T e,   B = (1 - M)^T W X,
/// so that their covariance is C B^T R B C with R that of e. Power that brakes a mass comes back
/// when it accelerates, so that F v, unlike |F v|, loses nothing to accelerations.
class MeasuredHeat {
 public:
  MeasuredHeat(const Measurements& measurements, const Thermal& thermal);

  /// (1 - M) of each column. columns: [N x q]; returns [N x q].
  Eigen::MatrixXd TakenOff(const Eigen::MatrixXd& columns) const;

  /// (1 - M)^T of each column. columns: [N x q], 0 at samples without weight; returns [N x q].
  Eigen::MatrixXd Transposed(const Eigen::MatrixXd& columns) const;

 private:
  Thermal thermal_;
  ThermalFilter filter_;
  Eigen::VectorXd velocity_;   // [N] rad/s or m/s
  Eigen::VectorXd direction_;  // [N] its sign
};

}  // namespace warmjoint
