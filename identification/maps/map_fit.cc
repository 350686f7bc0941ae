#include "identification/maps/map_fit.h"

#include <utility>

#include "identification/maps/holes.h"
#include "identification/maps/weights_in_line.h"
#include "identification/uncertainty/penalised_uncertainty.h"
#include "models/friction/prepared_map.h"

namespace warmjoint {
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

Uncertainty JudgeMaps(const MapProblem& problem, const MapFit& fit) {
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
  return JudgePenalised({fit.gram,
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
