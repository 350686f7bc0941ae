// Medians and quartiles of realizations, by column.
#pragma once

#include <Eigen/Core>

namespace warmjoint::report {

/// Median and quartiles of all realizations at each x. All: [K].
struct QuartileCurve {
  Eigen::VectorXd x;
  Eigen::VectorXd q25;
  Eigen::VectorXd median;
  Eigen::VectorXd q75;
};

/// values: [R x K], NaN left out; x: [K].
QuartileCurve QuartilesOf(const Eigen::VectorXd& x, const Eigen::MatrixXd& values);

}  // namespace warmjoint::report
