// Medians and quartiles of realizations, by column.
#pragma once

#include <Eigen/Core>
#include <string>

namespace warmjoint::figures {

/// Median and quartiles of all realizations at each x. All: [K].
struct QuartileCurve {
  Eigen::VectorXd x;
  Eigen::VectorXd q25;
  Eigen::VectorXd median;
  Eigen::VectorXd q75;
};

/// What a subtitle says of lines and bands of such curves: "table1: 50 realizations; lines are
/// medians, bands reach from quartile to quartile".
std::string MediansSubtitle(const std::string& suite, int realizations);

/// Of what is finite; NaN where nothing is.
double RootMeanSquare(const Eigen::VectorXd& values);

/// values: [R x K], NaN left out; x: [K].
QuartileCurve QuartilesOf(const Eigen::VectorXd& x, const Eigen::MatrixXd& values);

}  // namespace warmjoint::figures
