#include "identification/maps/map_fit.h"

#include <warmjoint/friction.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "identification/maps/holes.h"
#include "identification/maps/local_rows.h"
#include "identification/model/conditions.h"
#include "identification/model/normal_equations.h"
#include "identification/model/ridge.h"
#include "identification/uncertainty/tails.h"
#include "identification/uncertainty/weight_prior.h"
#include "models/friction/prepared_map.h"

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr double kImitated = 1e-3;  // share of a column's squares

/// The conditions under which the maps are orthogonal to the columns `shared`.
Conditions Deviating(const Eigen::MatrixXd& gram, Eigen::Index free,
                     const std::vector<Eigen::Index>& shared) {
  const Eigen::Index d = gram.rows(), count = static_cast<Eigen::Index>(shared.size());
  Conditions conditions{Eigen::MatrixXd::Zero(count, d), Eigen::VectorXd::Zero(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    conditions.rows.row(i).tail(d - free) =
        gram.row(shared[static_cast<size_t>(i)]).tail(d - free).normalized();
  }
  return conditions;
}

/// The correlation of the weights of one line. [n x n]
Eigen::MatrixXd CorrelationOf(const KernelLines& lines, double length) {
  const Index n = lines.length;
  Eigen::MatrixXd smear(n, n);
  // smoothed by the distance in kernels, around the circle where there is one
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
/// had been smoothed along each line of the first axis by a Gaussian of `length` / sqrt(2) spacings: far from the ends
/// exp(-d^2 / (2 length^2)) at d kernels' distance; 0 between lines. length > 0; returns [s x s] of the s seen ones.
Eigen::MatrixXd CorrelationInLines(const std::vector<FrictionMap>& maps,
                                   const std::vector<bool>& unseen, double length) {
  const auto q = static_cast<Index>(unseen.size());
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(q, q);
  Index first = 0;
  for (const FrictionMap& map : maps) {
    const KernelLines lines(map);
    const Index stride = lines.stride, size = lines.length * stride;
    const Eigen::MatrixXd line = CorrelationOf(lines, length);
    // kernels of one line have a distance of one stride
    for (Index k = 0; k < stride; ++k) {
      const auto of_line = Eigen::seq(first + k, first + size - stride + k, stride);
      all(of_line, of_line) = line;
    }
    first += size;
  }
  // only weights with data
  std::vector<Index> seen;
  for (Index k = 0; k < q; ++k) {
    if (!unseen[static_cast<size_t>(k)]) seen.push_back(k);
  }
  return all(seen, seen);
}

}  // namespace

std::vector<Eigen::Index> ImitatedColumns(const Eigen::MatrixXd& gram, Eigen::Index free) {
  const Eigen::Index q = gram.rows() - free;
  ShiftedCholesky kernels(gram.bottomRightCorner(q, q));
  std::vector<Eigen::Index> imitated;
  if (!kernels.Factor(1e-9 * gram.diagonal().tail(q).mean())) return imitated;
  // squares of each column that the kernels can imitate
  const Eigen::MatrixXd border = gram.bottomLeftCorner(q, free);
  const Eigen::VectorXd taken = border.cwiseProduct(kernels.Solve(border)).colwise().sum();
  // a column is imitated where hardly anything of it is left
  for (Eigen::Index j = 0; j < free; ++j) {
    if (gram(j, j) - taken[j] < kImitated * gram(j, j)) imitated.push_back(j);
  }
  return imitated;
}

std::vector<Eigen::Index> ImitatedLaw(const Eigen::MatrixXd& gram, Eigen::Index free,
                                      const std::vector<double>& lower) {
  std::vector<Eigen::Index> imitated = ImitatedColumns(gram, free);
  std::erase_if(imitated,
                [&](Eigen::Index j) { return !std::isfinite(lower[static_cast<size_t>(j)]); });
  return imitated;
}

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
      gram_(normal_.gram),
      shared_(ImitatedLaw(gram_, problem.free.cols(), problem.lower)) {
  const Eigen::Index free = problem.free.cols(), q = gram_.rows() - free;
  const Eigen::MatrixXd kernels = gram_.bottomRightCorner(q, q);
  // where there are no data, the neighbours give a better value than the law alone
  gram_.bottomRightCorner(q, q) += PenaltyOf(problem.maps, kernels, unseen_, strength);
  plain_ = std::make_shared<const Conditioned>(
      gram_, Conditions{Eigen::MatrixXd(0, gram_.rows()), Eigen::VectorXd(0)});
  deviating_ = shared_.empty() ? plain_
                               : std::make_shared<const Conditioned>(
                                     gram_, Deviating(normal_.gram, free, shared_));
}

RepeatedFit::Bounds RepeatedFit::Bounded() const {
  const std::vector<double>& lower = problem_.lower;
  Bounds bounds{deviating_->conditions(), {}};
  auto& [rows, values] = bounds.conditions;
  const Eigen::VectorXd after = deviating_->Solve(normal_.product);
  Eigen::VectorXd x;
  // every bound of a column that the fit would cross
  for (size_t j = 0; j < lower.size(); ++j) {
    const auto at = static_cast<Eigen::Index>(j);
    if (after[at] >= lower[j]) continue;

    // a bound does not contradict the data where the fit without conditions is beyond it, or differs from it by no more than noise
    if (x.size() == 0) x = plain_->Solve(normal_.product);
    const double noise = std::max(normal_.Squares(x), 0.0) / static_cast<double>(normal_.rows);
    const double below = std::max(0.0, lower[j] - x[at]);
    const double variance = noise * plain_->Solve(Eigen::VectorXd::Unit(after.size(), at))[at];
    const auto shared = std::ranges::find(shared_, at);
    // within its interval, where the data determine one
    const double reach =
        shared != shared_.end()
            ? std::sqrt(kNoChance)
            : StudentQuantile(std::numeric_limits<double>::infinity(), kIntervalLevel);
    if (below > reach * std::sqrt(variance)) continue;
    bounds.columns.push_back(at);
    Eigen::Index row = shared - shared_.begin();
    if (shared == shared_.end()) {
      row = rows.rows();
      rows.conservativeResize(row + 1, after.size());
      values.conservativeResize(row + 1);
    }
    rows.row(row) = Eigen::RowVectorXd::Unit(after.size(), at);
    values[row] = lower[j];
  }
  return bounds;
}

std::optional<Eigen::VectorXd> RepeatedFit::Unknowns() {
  if (!std::isfinite(normal_.squares) || !plain_->works() || !deviating_->works()) {
    return std::nullopt;
  }
  const Bounds bounds = Bounded();
  // the factors of the latest bounds are used again as long as the same bounds hold
  if (bounds.columns.empty()) {
    latest_ = deviating_;
  } else if (!latest_ || latest_->conditions() != bounds.conditions) {
    latest_ = std::make_shared<const Conditioned>(gram_, bounds.conditions);
  }
  if (!latest_->works()) return std::nullopt;
  Eigen::VectorXd x = latest_->Solve(normal_.product);
  // exactly at the bound, not off by rounding
  for (const Eigen::Index j : bounds.columns) x[j] = problem_.lower[static_cast<size_t>(j)];
  return x.allFinite() ? std::optional(x) : std::nullopt;
}

std::optional<MapWeights> RepeatedFit::Fit() {
  std::optional<Eigen::VectorXd> x = Unknowns();
  return x ? std::optional(At(std::move(*x))) : std::nullopt;
}

MapWeights RepeatedFit::At(Eigen::VectorXd x) const {
  const Eigen::Index free = problem_.free.cols();
  MapWeights fit{.of_law = {0, problem_.of_law},
                 .of_rigid = {problem_.of_law, free - problem_.of_law},
                 .of_weights = {free, x.size() - free},
                 .x = std::move(x),
                 .strength = strength_,
                 .unseen = unseen_};
  // fitted torque: law by its columns, maps by their weights
  const Eigen::VectorXd weights = fit.weights();
  fit.maps = WithWeights(problem_.maps, weights);
  fit.fitted = problem_.free * fit.x.head(free);
  fit.fitted +=
      problem_.rows ? problem_.rows->Times(weights) : EvaluateMaps(fit.maps, problem_.points);
  return fit;
}

Eigen::MatrixXd RepeatedFit::penalty() const {
  const Eigen::Index q = std::ssize(unseen_);
  return gram_.bottomRightCorner(q, q) - normal_.gram.bottomRightCorner(q, q);
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
    const std::optional<Eigen::VectorXd> x = Unknowns();
    if (!x) return std::nullopt;
    all.col(k) = *x;
  }
  return all;
}

MapFit RepeatedFit::Complete(MapWeights latest) const {
  MapFit fit{std::move(latest), 0, normal_.gram, {}};
  const auto& [rows, values] = latest_->conditions();
  const auto shared = static_cast<Eigen::Index>(shared_.size());
  fit.inverse = rows.rows() == shared
                    ? latest_->Inverse()
                    : Conditioned(gram_, {rows.topRows(shared), values.head(shared)}).Inverse();
  fit.effective = fit.inverse.cwiseProduct(fit.gram).sum();
  return fit;
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
  return CovarianceOf({.rows = rows,
                       .cofactor = fit.inverse,
                       .residual = problem.torque - fit.fitted,
                       .selection = problem.selection,
                       .fitted = fit.fitted,
                       .pull = WeightPrior{fit.gram, fit.free(), fit.weights(), fit.strength,
                                           fit.unseen, correlation}});
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
