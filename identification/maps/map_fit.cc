#include "identification/maps/map_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "identification/maps/holes.h"
#include "identification/ridge/local_ridge.h"
#include "identification/uncertainty/penalised_uncertainty.h"

namespace warmjoint::inline identification {
namespace {

constexpr double kImitated = 1e-3;  // share of a column's squares

}  // namespace

NormalEquations NormalOf(const MapProblem& problem) {
  return LocalNormal(problem.maps, problem.points, problem.free, problem.torque, 0,
                     problem.torque.size());
}

std::optional<MapFit> FitMaps(const MapProblem& problem, double strength) {
  const NormalEquations normal = NormalOf(problem);
  MapFit fit;
  fit.free = problem.free.cols();
  fit.strength = strength;
  fit.gram = normal.gram;
  const Eigen::Index d = normal.product.size();
  Eigen::MatrixXd gram = normal.gram;
  // where there are no data the neighbours tell more than the law alone
  fit.unseen = UnseenKernels(problem.maps, problem.points);
  gram.bottomRightCorner(d - fit.free, d - fit.free) +=
      strength * PriorOf(problem.maps, fit.unseen);
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

}  // namespace warmjoint::inline identification
