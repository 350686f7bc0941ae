#include "identification/map_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "identification/local_ridge.h"
#include "identification/penalised_uncertainty.h"

namespace warmjoint {
namespace {

constexpr int kStrengths = 20;
constexpr double kImitated = 1e-3;  // share of a column's squares

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

/// Whether the errors are those of the best within one standard error of the parts' differences.
bool AsGood(const Eigen::ArrayXd& squares, const Eigen::ArrayXd& best) {
  const Eigen::ArrayXd worse = squares - best;
  const auto parts = static_cast<double>(worse.size());
  const double deviation = std::sqrt((worse - worse.mean()).square().sum() / (parts - 1));
  return worse.sum() <= std::sqrt(parts) * deviation;
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
  const Eigen::MatrixXd squares = HeldOutSquares(parts, problem.free.cols(), strengths);
  const Eigen::VectorXd errors = squares.rowwise().sum() / static_cast<double>(n);
  ChosenStrength chosen = Best(strengths, {errors.begin(), errors.end()});
  const auto best = std::find(strengths.begin(), strengths.end(), chosen.strength);
  for (auto i = strengths.end(); i-- > best;) {
    const auto row = i - strengths.begin();
    if (!AsGood(squares.row(row), squares.row(best - strengths.begin()))) continue;
    chosen.strength = *i;
    break;
  }
  return chosen;
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
  fit.gram = normal.gram;
  const Eigen::Index d = normal.product.size();
  Eigen::MatrixXd gram = normal.gram;
  gram.diagonal().tail(d - fit.free).array() += strength;
  const Eigen::LLT<Eigen::MatrixXd> factors(gram);
  if (factors.info() != Eigen::Success || !std::isfinite(normal.squares)) return std::nullopt;
  fit.inverse = factors.solve(Eigen::MatrixXd::Identity(d, d));
  fit.x = factors.solve(normal.product);
  fit.effective = fit.inverse.cwiseProduct(fit.gram).sum();
  if (!fit.x.allFinite()) return std::nullopt;

  fit.maps = WithWeights(problem.maps, fit.x.tail(d - fit.free));
  fit.fitted = problem.free * fit.x.head(fit.free) + EvaluateMaps(fit.maps, problem.points);
  return fit;
}

std::vector<FrictionMap> WithWeights(std::vector<FrictionMap> maps,
                                     const Eigen::VectorXd& weights) {
  const double* weight = weights.data();
  for (FrictionMap& map : maps) {
    map.weights.assign(weight, weight + map.size());
    weight += map.size();
  }
  return maps;
}

Uncertainty JudgeMaps(const MapProblem& problem, const MapFit& fit) {
  const Eigen::Index d = fit.x.size();
  const auto rows = [&](Eigen::Index first, Eigen::Index last) {
    Eigen::MatrixXd dense(last - first, d);
    dense << problem.free.middleRows(first, last - first),
        DenseKernels(problem.maps, problem.points, first, last);
    return dense;
  };
  return JudgePenalised({fit.gram, fit.inverse, fit.free, fit.x.tail(d - fit.free), fit.strength},
                        rows, problem.torque - fit.fitted, problem.selection);
}

std::vector<Eigen::Index> ImitatedColumns(const MapFit& fit) {
  const Eigen::Index q = fit.x.size() - fit.free;
  EnvelopeCholesky kernels(fit.gram.bottomRightCorner(q, q));
  std::vector<Eigen::Index> imitated;
  if (!kernels.Factor(1e-9 * fit.gram.diagonal().tail(q).mean())) return imitated;
  const Eigen::MatrixXd border = fit.gram.bottomLeftCorner(q, fit.free);
  const Eigen::VectorXd taken = border.cwiseProduct(kernels.Solve(border)).colwise().sum();
  for (Eigen::Index j = 0; j < fit.free; ++j) {
    if (fit.gram(j, j) - taken[j] < kImitated * fit.gram(j, j)) imitated.push_back(j);
  }
  return imitated;
}

Eigen::VectorXd EvaluateMaps(const std::vector<FrictionMap>& maps, const MapPoints& points) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(points.rows());
  for (const FrictionMap& map : maps) {
    for (Eigen::Index i = 0; i < sum.size(); ++i) sum[i] += EvaluateMap(map, PointAt(points, i));
  }
  return sum;
}

}  // namespace warmjoint
