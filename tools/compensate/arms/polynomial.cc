// Compensator `polynomial`: a cubic in the speed whose coefficients follow a heat that nobody measures.
//
// F = sign(v) sum over i = 0 .. 3 of (a_i + b_i h) |v|^i, dh/dt = (|tau v| - h) / T: coefficients by least squares over the day before, T
// as of a grid the one that leaves least. The kind of model of Simoni, Beschi, Legnani, Visioli, "Modelling the temperature in joint
// friction of industrial manipulators", Robotica, doi:10.1017/S0263574717000509: polynomial, with a first-order heat fed by the lost power; how
// coefficients follow it is this file's.
#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "models/friction/sign.h"
#include "tools/compensate/arms/arm_list.h"

namespace warmjoint {
namespace {

constexpr int kTerms = 4;
using Coefficients = Eigen::Matrix<double, 2 * kTerms, 1>;

/// h at each sample, by the losses before it. time_constant: s. [N] W
Eigen::VectorXd HeatOf(const LogSamples& log, double time_constant) {
  const Eigen::VectorXd steps = StepsOf(log);
  Eigen::VectorXd heat = Eigen::VectorXd::Zero(log.size());
  for (Eigen::Index i = 1; i < log.size(); ++i) {
    const double loss = std::abs(log.torque[i - 1] * log.velocity[i - 1]);
    heat[i] = loss + (heat[i - 1] - loss) * std::exp(-steps[i] / time_constant);
  }
  return heat;
}

Coefficients RowOf(double velocity, double heat) {
  Coefficients row;
  double power = Sign(velocity);
  for (int i = 0; i < kTerms; ++i, power *= std::abs(velocity)) {
    row[i] = power;
    row[kTerms + i] = power * heat;
  }
  return row;
}

struct PolynomialFit {
  double time_constant = 0;  // s
  Coefficients coefficients = Coefficients::Zero();
  double left = std::numeric_limits<double>::infinity();  // sum of squares
};

PolynomialFit FitOf(const LogSamples& log, double time_constant) {
  const Eigen::VectorXd heat = HeatOf(log, time_constant);
  Eigen::Matrix<double, 2 * kTerms, 2 * kTerms> normal;
  normal.setZero();
  Coefficients right = Coefficients::Zero();
  double squares = 0;
  for (Eigen::Index i = 0; i < log.size(); ++i) {
    if (log.velocity[i] == 0) continue;
    const Coefficients row = RowOf(log.velocity[i], heat[i]);
    normal.selfadjointView<Eigen::Lower>().rankUpdate(row);
    right += row * log.torque[i];
    squares += log.torque[i] * log.torque[i];
  }
  PolynomialFit fit{time_constant};
  fit.coefficients = normal.selfadjointView<Eigen::Lower>().ldlt().solve(right);
  fit.left = squares - fit.coefficients.dot(right);
  return fit;
}

Eigen::VectorXd AlongPolynomial(const CompensatorInput& input) {
  // why: from the film of grease in a gear to the housing of an arm, by factors of sqrt(2)
  PolynomialFit best;
  for (double time_constant = 60; time_constant < 8000; time_constant *= std::sqrt(2.0)) {
    const PolynomialFit fit = FitOf(input.before, time_constant);
    if (fit.left < best.left) best = fit;
  }
  const LogSamples& log = input.log;
  const Eigen::VectorXd heat = HeatOf(log, best.time_constant);
  Eigen::VectorXd found = Eigen::VectorXd::Zero(log.size());
  for (Eigen::Index i = 0; i < log.size(); ++i) {
    if (log.velocity[i] != 0) found[i] = best.coefficients.dot(RowOf(log.velocity[i], heat[i]));
  }
  return found;
}

}  // namespace

CompensatorArm PolynomialInHeat() {
  return {"polynomial",
          "a cubic in the speed whose coefficients follow a heat, of the day before",
          {},
          AlongPolynomial};
}

}  // namespace warmjoint
