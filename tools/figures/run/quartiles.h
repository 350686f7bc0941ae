// Medians and quartiles of realizations, by column.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace warmjoint::figures {

/// Median and quartiles of all realizations at each x. All: [K].
struct QuartileCurve {
  Eigen::VectorXd x;
  Eigen::VectorXd q25;
  Eigen::VectorXd median;
  Eigen::VectorXd q75;
};

/// Of what is finite; NaN where nothing is.
double RootMeanSquare(const Eigen::VectorXd& values);

/// values: [R x K], NaN left out; x: [K].
QuartileCurve QuartilesOf(const Eigen::VectorXd& x, const Eigen::MatrixXd& values);

/// Of one sample, [R], NaN left out; NaN where nothing is left.
double MedianOf(const Eigen::VectorXd& values);

/// The finite ones, ascending.
std::vector<double> SortedFinite(const Eigen::VectorXd& values);

}  // namespace warmjoint::figures
