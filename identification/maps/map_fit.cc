#include "identification/maps/map_fit.h"

#include <warmjoint/friction.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "identification/maps/holes.h"
#include "identification/maps/kernel_lines.h"
#include "identification/uncertainty/penalised_uncertainty.h"
#include "models/friction/prepared_map.h"

namespace warmjoint {
namespace {

using Eigen::Index;

/// Of the weights of one line. [n x n]
Eigen::MatrixXd CorrelationOf(const KernelLines& lines, double length) {
  const auto n = static_cast<Index>(lines.length);
  Eigen::MatrixXd smear(n, n);
  // smeared with the distance in kernels, around the circle where there is one
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      const Index apart = std::abs(i - j);
      const auto away = static_cast<double>(lines.circular ? std::min(apart, n - apart) : apart);
      smear(i, j) = std::exp(-away * away / (length * length));
    }
  }
  // rows of norm 1 give a correlation of 1 with itself
  smear.rowwise().normalize();
  return smear * smear.transpose();
}

/// Correlation of the weights of maps, one map's after the other's, those `unseen` left out, as if independent ones
/// had been smeared along each line of the first axis by a Gaussian of `length` / sqrt(2) spacings: far from the ends
/// exp(-d^2 / (2 length^2)) at d kernels' distance; 0 between lines. length > 0; returns [s x s] of the s seen ones.
Eigen::MatrixXd CorrelationInLines(const std::vector<FrictionMap>& maps,
                                   const std::vector<bool>& unseen, double length) {
  const auto q = static_cast<Index>(unseen.size());
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(q, q);
  Index first = 0;
  for (const FrictionMap& map : maps) {
    const KernelLines lines(map);
    const auto stride = static_cast<Index>(lines.stride), size = static_cast<Index>(map.size());
    const Eigen::MatrixXd line = CorrelationOf(lines, length);
    // kernels of one line lie a stride apart
    for (Index k = 0; k < stride; ++k) {
      const auto of_line = Eigen::seq(first + k, first + size - stride + k, stride);
      all(of_line, of_line) = line;
    }
    first += size;
  }
  // weights with data alone
  std::vector<Index> seen;
  for (Index k = 0; k < q; ++k) {
    if (!unseen[static_cast<size_t>(k)]) seen.push_back(k);
  }
  return all(seen, seen);
}

}  // namespace
NormalEquations NormalOf(const MapProblem& problem) {
  if (problem.rows) return problem.rows->Normal(problem.free, problem.torque);
  return LocalNormal(problem.maps, problem.points, problem.free, problem.torque, 0,
                     problem.torque.size());
}

RepeatedFit::RepeatedFit(const MapProblem& problem, NormalEquations normal, double strength)
    : problem_(problem),
      normal_(std::move(normal)),
      strength_(strength),
      unseen_(UnseenKernels(problem.maps, problem.points)),
      system_(problem.maps, normal_.gram, problem.free.cols(), strength, unseen_, problem.lower) {}

std::optional<MapWeights> RepeatedFit::Fit() {
  std::optional<Eigen::VectorXd> x = system_.Solve(normal_);
  if (!x) return std::nullopt;
  MapWeights fit{problem_.free.cols(), std::move(*x), strength_, {}, {}, unseen_};
  // fitted torque: law by its columns, maps by their weights
  const Eigen::VectorXd weights = fit.x.tail(fit.x.size() - fit.free);
  fit.maps = WithWeights(problem_.maps, weights);
  fit.fitted = problem_.free * fit.x.head(fit.free);
  fit.fitted +=
      problem_.rows ? problem_.rows->Times(weights) : EvaluateMaps(fit.maps, problem_.points);
  return fit;
}

Eigen::MatrixXd RepeatedFit::Products(const Eigen::Ref<const Eigen::MatrixXd>& torques) const {
  Eigen::MatrixXd products(normal_.product.size(), torques.cols());
  products << problem_.free.transpose() * torques,
      problem_.rows ? problem_.rows->Products(torques)
                    : LocalProducts(problem_.maps, problem_.points, torques);
  return products;
}

std::optional<MapWeights> RepeatedFit::To(const Eigen::VectorXd& torque) {
  normal_.product = Products(torque);
  normal_.squares = torque.squaredNorm();
  return Fit();
}

std::optional<Eigen::MatrixXd> RepeatedFit::Solve(const Eigen::MatrixXd& torques) {
  Eigen::MatrixXd all = Products(torques);
  // the normal matrix stays; each torque has its own products
  for (Eigen::Index k = 0; k < all.cols(); ++k) {
    normal_.product = all.col(k);
    normal_.squares = torques.col(k).squaredNorm();
    const std::optional<Eigen::VectorXd> x = system_.Solve(normal_);
    if (!x) return std::nullopt;
    all.col(k) = *x;
  }
  return all;
}

MapFit RepeatedFit::Complete(MapWeights latest) const {
  MapFit fit{std::move(latest), 0, normal_.gram, system_.Inverse()};
  fit.effective = fit.inverse.cwiseProduct(fit.gram).sum();
  return fit;
}

std::optional<MapFit> FitMaps(const MapProblem& problem, double strength) {
  return FitMaps(problem, NormalOf(problem), strength);
}

std::optional<MapFit> FitMaps(const MapProblem& problem, NormalEquations normal, double strength) {
  RepeatedFit fits(problem, std::move(normal), strength);
  std::optional<MapWeights> fit = fits.Fit();
  return fit ? std::optional(fits.Complete(std::move(*fit))) : std::nullopt;
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

Uncertainty MapCovariance(const MapProblem& problem, const MapFit& fit) {
  const Eigen::Index d = fit.x.size();
  // rows of law and kernels for a range of samples
  const auto rows = [&](Eigen::Index first, Eigen::Index last) {
    Eigen::MatrixXd dense(last - first, d);
    dense << problem.free.middleRows(first, last - first),
        DenseKernels(problem.maps, problem.points, first, last);
    return dense;
  };
  const auto correlation = [&](double length) {
    return CorrelationInLines(fit.maps, fit.unseen, length);
  };
  return PenalisedCovariance({fit.gram,
                              fit.inverse,
                              fit.free,
                              fit.x.tail(d - fit.free),
                              fit.strength,
                              fit.unseen,
                              {},
                              correlation},
                             rows, problem.torque - fit.fitted, problem.selection);
}

Eigen::VectorXd EvaluateMaps(const std::vector<FrictionMap>& maps, const MapPoints& points) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(points.rows());
  for (const FrictionMap& map : maps) {
    const PreparedMap ready(map);
    for (Eigen::Index i = 0; i < sum.size(); ++i) sum[i] += ready.Value(PointAt(points, i));
  }
  return sum;
}

}  // namespace warmjoint
