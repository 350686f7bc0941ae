#include "identification/uncertainty/uncertainty.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <limits>

namespace warmjoint {
namespace {

constexpr double kUneven = 4;        // deviations
constexpr double kLeastLevel = 0.2;  // of the line through |r|, of its mean

/// Of a column whose mean is 0 and another one.
double Correlation(const Eigen::VectorXd& centred, const Eigen::Ref<const Eigen::VectorXd>& other) {
  const double spread = (other.array() - other.mean()).square().sum();
  const double norm = centred.norm() * std::sqrt(spread);
  return norm > 0 ? centred.dot(other) / norm : 0;
}

/// [n x 2] or [n x 1]: time, |f|
Eigen::MatrixXd Circumstances(Eigen::Index n, const Eigen::VectorXd& fitted) {
  Eigen::MatrixXd known(n, fitted.size() > 0 ? 2 : 1);
  known.col(0).setLinSpaced(0, 1);
  if (fitted.size() > 0) known.col(1) = fitted.cwiseAbs();
  return known;
}

/// By how many deviations r^2 goes with a column. Of coloured noise, fewer samples count.
double Unevenness(const Eigen::VectorXd& residual, const Eigen::MatrixXd& known,
                  const NoiseModel& noise) {
  Eigen::VectorXd squares = residual.cwiseAbs2();
  squares.array() -= squares.mean();
  double most = 0;
  for (const auto& column : known.colwise()) {
    most = std::max(most, std::abs(Correlation(squares, column)));
  }
  return most * std::sqrt(static_cast<double>(residual.size()) / noise.variance_inflation);
}

/// The line through |r|, as a share of the residual's rms. [n]
Eigen::VectorXd Levels(const Eigen::VectorXd& residual, const Eigen::MatrixXd& known) {
  Eigen::MatrixXd columns(known.rows(), known.cols() + 1);
  columns << Eigen::VectorXd::Ones(known.rows()), known;
  const Eigen::VectorXd size = residual.cwiseAbs();
  const Eigen::VectorXd line = columns * columns.colPivHouseholderQr().solve(size);
  const Eigen::VectorXd level = line.cwiseMax(kLeastLevel * size.mean());
  return level / std::sqrt(level.squaredNorm() / static_cast<double>(level.size()));
}

}  // namespace

Uncertainty EstimateCovariance(const std::function<Eigen::MatrixXd()>& jacobian,
                               const Eigen::MatrixXd& cofactor, const Eigen::VectorXd& residual,
                               const Selection& selection, const Eigen::VectorXd& fitted,
                               const Eigen::VectorXd& prior) {
  Uncertainty result;
  result.noise = FitNoise(residual, selection);
  const auto n = static_cast<double>(residual.size());
  const auto d = static_cast<double>(cofactor.rows());
  // whether the residual grows with time or with friction
  const Eigen::MatrixXd known = Circumstances(residual.size(), fitted);
  const double uneven = Unevenness(residual, known, result.noise);
  if (uneven > kUneven) result.uneven = uneven;

  // white and even: (J^T R J) C is s^2 times the identity
  result.white = residual.squaredNorm() / std::max(n - d, 1.0) * cofactor;
  if (result.noise.order() == 0 && result.uneven == 0) {
    result.degrees_of_freedom = n - d;
    result.covariance = residual.squaredNorm() / result.degrees_of_freedom * cofactor;
    return result;
  }

  Eigen::MatrixXd rows = jacobian();
  // errors by the scatter of the rows, and by that of what was known beforehand
  const auto spread = [&](Eigen::MatrixXd scatter) -> Eigen::MatrixXd {
    if (prior.size() > 0) scatter.diagonal() += result.noise.variance * prior;
    return cofactor * scatter * cofactor;
  };
  // white but uneven: each row by its own residual
  if (result.noise.order() == 0) {
    rows = residual.asDiagonal() * rows;
    result.degrees_of_freedom = n - d;
    result.covariance = n / result.degrees_of_freedom * spread(rows.transpose() * rows);
    return result;
  }

  // coloured: what the fit took up counts in samples, at most half of them
  if (result.uneven > 0) {
    const Eigen::VectorXd level = Levels(residual, known);
    result.noise = FitNoise(residual.cwiseQuotient(level), selection);
    rows = level.asDiagonal() * rows;
  }
  const Eigen::MatrixXd scatter = ScatterThrough(result.noise, rows, selection);
  const double taken = std::min((cofactor * scatter).trace() / result.noise.variance, 0.5 * n);
  result.degrees_of_freedom = std::max(n / result.noise.variance_inflation - d, 1.0);
  result.covariance = n / (n - taken) * spread(scatter);
  return result;
}

Uncertainty Picked(Uncertainty known, const std::vector<Eigen::Index>& places) {
  for (Eigen::MatrixXd* const one : {&known.covariance, &known.white, &known.by_samples}) {
    if (one->size() > 0) *one = (*one)(places, places).eval();
  }
  return known;
}

double RoundingVariance(const Eigen::VectorXd& torque) {
  if (torque.size() == 0) return 0;
  const double error = static_cast<double>(torque.size()) * std::numeric_limits<double>::epsilon() *
                       torque.cwiseAbs().maxCoeff();
  return error * error;
}

bool IsRounding(double squares, const Eigen::VectorXd& torque) {
  return squares <= static_cast<double>(torque.size()) * RoundingVariance(torque);
}

double ExplainedVariances(double without, double with, double degrees_of_freedom,
                          const Eigen::VectorXd& torque) {
  return IsRounding(without, torque) ? 0
                                     : (without - with) / with * std::max(degrees_of_freedom, 1.0);
}

std::string ColourOf(const NoiseModel& noise) {
  if (noise.order() == 0) return "";
  return fmt::format(
      "; noise is coloured (correlation {:.2f} between neighbours), which the intervals account "
      "for",
      noise.correlation);
}

std::string NoiseOf(const Uncertainty& known) {
  if (known.uneven == 0) return ColourOf(known.noise);
  return fmt::format(
             "; the noise is uneven (its variance changes with torque or time, {:.2g} standard "
             "errors beyond chance), which the intervals account for",
             known.uneven) +
         ColourOf(known.noise);
}

}  // namespace warmjoint
