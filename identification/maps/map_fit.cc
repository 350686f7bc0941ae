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
constexpr double kChance = 6.63;    // chi-squared of one degree of freedom, 1 %

/// x and inverse of gram x = product; false where it is singular.
bool Solve(const Eigen::MatrixXd& gram, const Eigen::VectorXd& product, MapFit& fit) {
  const Eigen::LLT<Eigen::MatrixXd> factors(gram);
  if (factors.info() != Eigen::Success) return false;
  const Eigen::Index d = product.size();
  fit.inverse = factors.solve(Eigen::MatrixXd::Identity(d, d));
  fit.x = factors.solve(product);
  return fit.x.allFinite();
}

/// Mean square of the residual, (N.m)^2 or N^2.
double MeanSquare(const NormalEquations& normal, const Eigen::VectorXd& x, Eigen::Index samples) {
  const double sum = normal.squares - 2 * x.dot(normal.product) + x.dot(normal.gram * x);
  return std::max(sum, 0.0) / static_cast<double>(samples);
}

/// Whether one of the free parameters lies below its bound.
bool LiesBelow(const std::vector<double>& lower, const Eigen::VectorXd& x) {
  for (size_t j = 0; j < lower.size(); ++j) {
    if (x[static_cast<Eigen::Index>(j)] < lower[j]) return true;
  }
  return false;
}

/// Puts a parameter of the law that lies below its bound onto it where that costs less than noise does and the
/// kernels take up the difference: how a constant is shared out between law and maps is the prior's taste
/// alone. All others stay where the data put them. gram: normal's with the prior.
void HoldAtBounds(const MapProblem& problem, const NormalEquations& normal, Eigen::MatrixXd gram,
                  MapFit& fit) {
  if (!LiesBelow(problem.lower, fit.x)) return;
  const double noise = MeanSquare(normal, fit.x, problem.torque.size());
  Eigen::VectorXd product = normal.product;
  for (const Eigen::Index j : ImitatedColumns(fit)) {
    const double bound = problem.lower[static_cast<size_t>(j)], below = bound - fit.x[j];
    const bool cheap = below * below <= kChance * noise * fit.inverse(j, j);
    if (!(below > 0) || !cheap) continue;
    product -= bound * gram.col(j);
    product[j] = bound;
    gram.row(j).setZero();
    gram.col(j).setZero();
    gram(j, j) = 1;
    MapFit held = fit;
    if (!Solve(gram, product, held)) return;
    fit = held;
    fit.inverse.row(j).setZero();
    fit.inverse.col(j).setZero();
  }
}

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
  const Eigen::Index q = d - fit.free;
  const double pull = PullOver(normal.gram.bottomRightCorner(q, q), fit.unseen, strength);
  gram.bottomRightCorner(q, q) += strength * PriorOf(problem.maps, fit.unseen, pull);
  if (!std::isfinite(normal.squares) || !Solve(gram, normal.product, fit)) return std::nullopt;
  HoldAtBounds(problem, normal, gram, fit);
  fit.effective = fit.inverse.cwiseProduct(fit.gram).sum();

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
