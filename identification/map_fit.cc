#include "identification/map_fit.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "identification/local_ridge.h"

namespace warmjoint {
namespace {

constexpr int kStrengths = 20;
constexpr double kSoft = 1e-3;  // share of a column's squares that kernels leave, beside 1

NormalEquations AllNormal(const MapProblem& problem) {
  return LocalNormal(problem.maps, problem.points, problem.free, problem.torque, 0,
                     problem.torque.size());
}

/// Half decades from 1e-7 of the mean diagonal of the kernels' Gram matrix.
std::vector<double> Strengths(const NormalEquations& normal, Eigen::Index free) {
  const double scale = normal.gram.diagonal().tail(normal.product.size() - free).mean();
  std::vector<double> strengths;
  for (int i = 0; i < kStrengths; ++i) strengths.push_back(scale * std::pow(10, -7 + 0.5 * i));
  return strengths;
}

ChosenStrength Best(const std::vector<double>& strengths, const std::vector<double>& errors) {
  ChosenStrength best{strengths.back(), std::numeric_limits<double>::infinity()};
  for (size_t i = 0; i < strengths.size(); ++i) {
    if (errors[i] < best.criterion) best = {strengths[i], errors[i]};
  }
  return best;
}

ChosenStrength ByCrossValidation(const MapProblem& problem, int folds) {
  const Eigen::Index n = problem.torque.size();
  std::vector<NormalEquations> parts;
  for (Eigen::Index i = 0; i < folds; ++i) {
    parts.push_back(LocalNormal(problem.maps, problem.points, problem.free, problem.torque,
                                i * n / folds, (i + 1) * n / folds));
  }
  NormalEquations all = parts[0];
  for (size_t i = 1; i < parts.size(); ++i) all = all.Plus(parts[i]);
  const std::vector<double> strengths = Strengths(all, problem.free.cols());
  const Eigen::VectorXd errors = CrossValidate(parts, problem.free.cols(), strengths);
  return Best(strengths, {errors.begin(), errors.end()});
}

ChosenStrength ByLeavingOut(const MapProblem& problem) {
  const NormalEquations normal = AllNormal(problem);
  const std::vector<RowGroup> groups =
      GroupRows(problem.maps, problem.points, 0, problem.torque.size());
  const std::vector<double> strengths = Strengths(normal, problem.free.cols());
  std::vector<double> errors;
  for (const double strength : strengths) {
    errors.push_back(LeaveOneOut(groups, problem.free, problem.torque, normal, strength));
  }
  return Best(strengths, errors);
}

ChosenStrength ByEvidence(const MapProblem& problem) {
  const NormalEquations normal = AllNormal(problem);
  const Evidence evidence = MaximiseEvidence(normal, problem.free.cols());
  const double highest = Strengths(normal, problem.free.cols()).back();
  const double strength = evidence.strength();
  const double criterion = -2 * evidence.log_evidence / static_cast<double>(normal.rows);
  // without any sign of the kernels it grows without bounds
  if (!std::isfinite(criterion) || !(strength < highest)) {
    return {highest, std::isfinite(criterion) ? criterion : 0};
  }
  return {strength, criterion};
}

/// Free columns of which the kernels, nearly unpenalised, leave less than kSoft.
std::vector<Eigen::Index> SoftColumns(const NormalEquations& normal, Eigen::Index free) {
  const Eigen::Index q = normal.product.size() - free;
  EnvelopeCholesky kernels(normal.gram.bottomRightCorner(q, q));
  const double scale = normal.gram.diagonal().tail(q).mean();
  std::vector<Eigen::Index> soft;
  if (!kernels.Factor(1e-9 * scale)) return soft;
  const Eigen::MatrixXd border = normal.gram.bottomLeftCorner(q, free);
  const Eigen::VectorXd taken = border.cwiseProduct(kernels.Solve(border)).colwise().sum();
  for (Eigen::Index j = 0; j < free; ++j) {
    if (normal.gram(j, j) - taken[j] < kSoft * normal.gram(j, j)) soft.push_back(j);
  }
  return soft;
}

/// Rows [free columns, kernels] of some kept samples.
Eigen::MatrixXd DenseRows(const MapProblem& problem, Eigen::Index first, Eigen::Index last) {
  const Eigen::Index p = problem.free.cols();
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(last - first, p + KernelCount(problem.maps));
  rows.leftCols(p) = problem.free.middleRows(first, last - first);
  for (const RowGroup& group : GroupRows(problem.maps, problem.points, first, last)) {
    for (size_t i = 0; i < group.samples.size(); ++i) {
      for (size_t k = 0; k < group.kernels.size(); ++k) {
        rows(group.samples[i] - first, p + group.kernels[k]) = group.values(i, k);
      }
    }
  }
  return rows;
}

/// Covariance of the errors, degrees of freedom and noise. C: (A^T A + s P)^-1.
Uncertainty Judge(const MapProblem& problem, const NormalEquations& normal,
                  const Eigen::MatrixXd& C, const MapFit& fit) {
  const Eigen::VectorXd residual = problem.torque - fit.fitted;
  const auto n = static_cast<double>(residual.size());
  const Eigen::Index q = fit.x.size() - fit.free;
  Uncertainty result;
  result.noise = FitNoise(residual, problem.selection);
  const NoiseModel& noise = result.noise;
  const Eigen::MatrixXd scatter =
      noise.order() == 0
          ? Eigen::MatrixXd(noise.variance * normal.gram)
          : ScatterThrough(
                noise, [&](auto first, auto last) { return DenseRows(problem, first, last); },
                fit.x.size(), problem.selection);

  // E|r|^2 = tr R - 2 tr(C S) + tr(C G C S), in samples of which at most half are taken up
  const Eigen::MatrixXd taken_up = C * scatter;
  const Eigen::MatrixXd hat = C * normal.gram;
  const double taken = std::clamp(
      (2 * taken_up.trace() - hat.cwiseProduct(taken_up.transpose()).sum()) / noise.variance, 0.0,
      0.5 * n);
  const Eigen::MatrixXd by_noise = n / (n - taken) * taken_up * C;

  // what the prior pulls away
  const Eigen::MatrixXd pull = fit.strength * C.rightCols(q);
  const Eigen::MatrixXd kept = Eigen::MatrixXd::Identity(q, q) - pull.bottomRows(q);
  const auto weights = by_noise.bottomRightCorner(q, q);
  const double seen = fit.x.tail(q).squaredNorm() - weights.trace();
  const double unseen = std::sqrt(2.0) * weights.norm();
  const double prior = std::max(seen, unseen) / std::max(kept.squaredNorm(), 1e-12);
  result.covariance = by_noise + prior * pull * pull.transpose();
  result.freedom = std::max(n / noise.redundancy - fit.effective, 1.0);
  return result;
}

}  // namespace

ChosenStrength ChooseStrength(const MapProblem& problem, StrengthRule rule, int folds) {
  switch (rule) {
    case StrengthRule::cross_validation:
      return ByCrossValidation(problem, folds);
    case StrengthRule::leave_one_out:
      return ByLeavingOut(problem);
    case StrengthRule::evidence:
      break;
  }
  return ByEvidence(problem);
}

std::optional<MapFit> FitMaps(const MapProblem& problem, double strength) {
  const NormalEquations normal = AllNormal(problem);
  MapFit fit;
  fit.free = problem.free.cols();
  fit.strength = strength;
  const Eigen::Index d = normal.product.size();
  Eigen::MatrixXd gram = normal.gram;
  gram.diagonal().tail(d - fit.free).array() += strength;
  const Eigen::LLT<Eigen::MatrixXd> factors(gram);
  if (factors.info() != Eigen::Success || !std::isfinite(normal.squares)) return std::nullopt;
  const Eigen::MatrixXd C = factors.solve(Eigen::MatrixXd::Identity(d, d));
  fit.x = factors.solve(normal.product);
  fit.effective = C.cwiseProduct(normal.gram).sum();
  if (!fit.x.allFinite()) return std::nullopt;

  // the maps, and what they give
  fit.maps = problem.maps;
  const double* weight = fit.x.data() + fit.free;
  fit.fitted = problem.free * fit.x.head(fit.free);
  for (FrictionMap& map : fit.maps) {
    map.weights.assign(weight, weight + map.size());
    weight += map.size();
    for (Eigen::Index i = 0; i < fit.fitted.size(); ++i) {
      fit.fitted[i] += EvaluateMap(map, PointAt(problem.points, i));
    }
  }
  fit.soft = SoftColumns(normal, fit.free);
  fit.known = Judge(problem, normal, C, fit);
  return fit;
}

}  // namespace warmjoint
