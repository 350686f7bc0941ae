#include "identification/uncertainty/uncertainty.h"

#include <Eigen/QR>
#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "identification/model/normal_equations.h"
#include "identification/sentences/fit.h"
#include "identification/uncertainty/few_segments.h"

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr double kUneven = 4;        // deviations
constexpr double kLeastLevel = 0.2;  // of the line through |r|, of its mean

/// The correlation of a column whose mean is 0 with another one.
double Correlation(const Eigen::VectorXd& centred, const Eigen::Ref<const Eigen::VectorXd>& other) {
  const double spread = (other.array() - other.mean()).square().sum();
  const double norm = centred.norm() * std::sqrt(spread);
  return norm > 0 ? centred.dot(other) / norm : 0;
}

/// [n x 2] or [n x 1]: time, |f|
Eigen::MatrixXd Circumstances(Eigen::Index n, const Eigen::VectorXd& fitted) {
  Eigen::MatrixXd columns(n, fitted.size() > 0 ? 2 : 1);
  columns.col(0).setLinSpaced(0, 1);
  if (fitted.size() > 0) columns.col(1) = fitted.cwiseAbs();
  return columns;
}

/// By how many deviations r^2 correlates with a column. Of coloured noise, fewer samples count.
double Unevenness(const Eigen::VectorXd& residual, const Eigen::MatrixXd& circumstances,
                  const NoiseModel& noise) {
  Eigen::VectorXd squares = residual.cwiseAbs2();
  squares.array() -= squares.mean();
  double most = 0;
  for (const auto& column : circumstances.colwise()) {
    most = std::max(most, std::abs(Correlation(squares, column)));
  }
  return most * std::sqrt(static_cast<double>(residual.size()) / noise.variance_inflation);
}

/// The line through |r|, as a share of the residual's rms. [n]
Eigen::VectorXd Levels(const Eigen::VectorXd& residual, const Eigen::MatrixXd& circumstances) {
  Eigen::MatrixXd columns(circumstances.rows(), circumstances.cols() + 1);
  columns << Eigen::VectorXd::Ones(circumstances.rows()), circumstances;
  const Eigen::VectorXd size = residual.cwiseAbs();
  const Eigen::VectorXd line = columns * columns.colPivHouseholderQr().solve(size);
  const Eigen::VectorXd level = line.cwiseMax(kLeastLevel * size.mean());
  return level / std::sqrt(level.squaredNorm() / static_cast<double>(level.size()));
}

constexpr Index kBlock = 4096;  // rows at a time

/// J^T R J, [d x d], and the part of the residual that the fit took up, in samples.
struct Scatter {
  Eigen::MatrixXd of_rows;
  double taken = 0;
};

/// The scatter of white noise, whose variance is constant or not.
Eigen::MatrixXd WhiteScatter(const FittedRows& fit, const Uncertainty& uncertainty) {
  if (uncertainty.uneven == 0) return uncertainty.noise.variance * fit.pull->gram;
  // each row by its own residual
  const Index n = fit.residual.size(), d = fit.cofactor.rows();
  Eigen::MatrixXd scatter = Eigen::MatrixXd::Zero(d, d);
  for (Index first = 0; first < n; first += kBlock) {
    const Index last = std::min(first + kBlock, n);
    const Eigen::MatrixXd rows =
        fit.residual.segment(first, last - first).asDiagonal() * fit.rows(first, last);
    scatter += rows.transpose() * rows;
  }
  return scatter;
}

/// The scatter of coloured noise. Where its variance is not constant, the rows are weighted by its level, and the colour is
/// that of the residual divided by the level.
Eigen::MatrixXd ColouredScatter(const FittedRows& fit, const Eigen::MatrixXd& circumstances,
                                Uncertainty& uncertainty) {
  const Index d = fit.cofactor.rows();
  if (uncertainty.uneven == 0) return ScatterThrough(uncertainty.noise, fit.rows, d, fit.selection);
  const Eigen::VectorXd level = Levels(fit.residual, circumstances);
  uncertainty.noise = FitNoise(fit.residual.cwiseQuotient(level), fit.selection);
  const auto weighted = [&](Index first, Index last) -> Eigen::MatrixXd {
    return level.segment(first, last - first).asDiagonal() * fit.rows(first, last);
  };
  return ScatterThrough(uncertainty.noise, weighted, d, fit.selection);
}

/// The uncertainty of a fit to weighted rows.
Uncertainty OfWeighted(const FittedRows& fit) {
  Uncertainty uncertainty;
  uncertainty.noise = FitNoise(fit.residual, fit.selection);
  const auto weighted = [&](Index first, Index last) -> Eigen::MatrixXd {
    return fit.weights.segment(first, last - first).asDiagonal() * fit.rows(first, last);
  };
  const Index d = fit.cofactor.rows();
  uncertainty.covariance =
      fit.cofactor *
      ScatterThrough(uncertainty.noise, weighted(0, fit.residual.size()), fit.selection) *
      fit.cofactor;
  uncertainty.degrees_of_freedom = DegreesOfFreedomOfWeights(fit.weights, uncertainty.noise, d);
  return uncertainty;
}

/// The uncertainty of a fit to an exact log, which is that by the rounding of doubles.
Uncertainty OfRounding(const FittedRows& fit) {
  Uncertainty exact;
  exact.noise.variance = exact.noise.innovation = RoundingVariance(fit.fitted + fit.residual);
  exact.covariance = exact.noise.variance * fit.cofactor;
  exact.degrees_of_freedom =
      std::max(static_cast<double>(fit.residual.size() - fit.cofactor.rows()), 1.0);
  return exact;
}

/// The part of the residual that a fit with a prior's pull takes up: E|r|^2 = tr R - 2 tr(C S) + tr(C G C S), at most half of the samples.
double TakenBesidePull(const Eigen::MatrixXd& hat, const Eigen::MatrixXd& spread, double variance,
                       double samples) {
  const double product = hat.cwiseProduct(spread.transpose()).sum();
  return std::clamp((2 * spread.trace() - product) / variance, 0.0, 0.5 * samples);
}

/// Sets the covariance from the noise, from the pull and from what was known.
void BesidePull(const FittedRows& fit, const Eigen::MatrixXd& scatter, Uncertainty& uncertainty) {
  const Eigen::MatrixXd& C = fit.cofactor;
  const auto n = static_cast<double>(fit.residual.size());
  const Eigen::MatrixXd hat = C * fit.pull->gram, spread = C * scatter;
  const double taken = TakenBesidePull(hat, spread, uncertainty.noise.variance, n);
  Eigen::MatrixXd by_noise(C.rows(), C.rows());
  by_noise.triangularView<Eigen::Lower>() = n / (n - taken) * spread * C;
  by_noise.triangularView<Eigen::StrictlyUpper>() = by_noise.transpose();
  uncertainty.covariance = by_noise + CovarianceByPull(*fit.pull, C, hat, by_noise);
  // what was known beforehand has the error of a measurement of that weight
  if (fit.prior.size() > 0) {
    uncertainty.covariance += uncertainty.noise.variance * (C * fit.prior * C);
  }
  // independent samples less effective parameters
  uncertainty.degrees_of_freedom =
      std::max(n / uncertainty.noise.variance_inflation - hat.trace(), 1.0);
}

/// The parameters that the data determine, and not what was known beforehand: d - tr(C P).
double Determined(const FittedRows& fit) {
  const auto d = static_cast<double>(fit.cofactor.rows());
  return fit.prior.size() > 0 ? d - fit.cofactor.cwiseProduct(fit.prior).sum() : d;
}

/// Sets the covariance from the noise and from what was known.
void OfSquares(const FittedRows& fit, Eigen::MatrixXd scatter, Uncertainty& uncertainty) {
  const Eigen::MatrixXd& C = fit.cofactor;
  const auto n = static_cast<double>(fit.residual.size());
  const double d = Determined(fit);
  // the part that the fit took up, as a number of samples, of coloured noise at most half of them
  double taken = d;
  uncertainty.degrees_of_freedom = n - d;
  if (uncertainty.noise.order() > 0) {
    taken = std::min((C * scatter).trace() / uncertainty.noise.variance, 0.5 * n);
    uncertainty.degrees_of_freedom = std::max(n / uncertainty.noise.variance_inflation - d, 1.0);
  }
  if (fit.prior.size() > 0) {
    const double variance =
        fit.prior_variance > 0 ? fit.prior_variance : uncertainty.noise.variance;
    scatter += variance * fit.prior;
  }
  uncertainty.covariance = n / (n - taken) * (C * scatter * C);
}

}  // namespace

RowsBetween RowsFrom(std::function<Eigen::MatrixXd()> all) {
  // made once
  auto rows = std::make_shared<std::optional<Eigen::MatrixXd>>();
  return [rows, all = std::move(all)](Index first, Index last) -> Eigen::MatrixXd {
    if (!*rows) *rows = all();
    return (*rows)->middleRows(first, last - first);
  };
}

Uncertainty CovarianceOf(const FittedRows& fit) {
  if (fit.weights.size() > 0) return OfWeighted(fit);
  const double squares = fit.residual.squaredNorm();
  if (fit.fitted.size() > 0 && IsRounding(squares, fit.fitted + fit.residual)) {
    return OfRounding(fit);
  }
  Uncertainty uncertainty;
  uncertainty.noise = FitNoise(fit.residual, fit.selection);
  const Index n = fit.residual.size(), d = fit.cofactor.rows();
  // whether the residual grows with time or with friction
  const Eigen::MatrixXd circumstances = Circumstances(n, fit.fitted);
  const double uneven = Unevenness(fit.residual, circumstances, uncertainty.noise);
  if (uneven > kUneven) uncertainty.uneven = uneven;

  const bool is_white = uncertainty.noise.order() == 0;
  const auto scatter = [&] {
    return is_white ? WhiteScatter(fit, uncertainty)
                    : ColouredScatter(fit, circumstances, uncertainty);
  };
  if (fit.pull) {
    BesidePull(fit, scatter(), uncertainty);
    return uncertainty;
  }
  uncertainty.white = squares / std::max(static_cast<double>(n - d), 1.0) * fit.cofactor;
  if (is_white && uncertainty.uneven == 0) {
    // (J^T R J + v P) C is the variance times the identity
    uncertainty.degrees_of_freedom = static_cast<double>(n) - Determined(fit);
    uncertainty.covariance = squares / uncertainty.degrees_of_freedom * fit.cofactor;
  } else {
    OfSquares(fit, scatter(), uncertainty);
  }
  const bool has_prior = fit.prior.size() > 0 && !fit.prior.isZero();
  if (!has_prior && HasFewSegments(fit.selection, d)) {
    CountSegments(fit.rows(0, n), fit.cofactor, fit.residual, fit.selection, uncertainty);
  }
  return uncertainty;
}

double DegreesOfFreedomOfWeights(const Eigen::VectorXd& weights, const NoiseModel& noise,
                                 Eigen::Index d) {
  const double sum = weights.sum();
  const double effective = sum * sum / weights.squaredNorm();
  return std::max(effective / noise.variance_inflation - static_cast<double>(d), 1.0);
}

Uncertainty Picked(Uncertainty uncertainty, const std::vector<Eigen::Index>& places) {
  for (Eigen::MatrixXd* const one :
       {&uncertainty.covariance, &uncertainty.white, &uncertainty.by_samples}) {
    if (one->size() > 0) *one = (*one)(places, places).eval();
  }
  return uncertainty;
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
  return noise.order() == 0 ? "" : ExplainColour(noise.correlation);
}

std::string NoiseOf(const Uncertainty& uncertainty) {
  if (uncertainty.uneven == 0) return ColourOf(uncertainty.noise);
  return ExplainUnevenness(uncertainty.uneven) + ColourOf(uncertainty.noise);
}

}  // namespace warmjoint
