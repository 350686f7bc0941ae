#include "identification/maps/map_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "identification/maps/holes.h"
#include "identification/maps/imitated_columns.h"
#include "identification/ridge/local_ridge.h"
#include "identification/uncertainty/penalised_uncertainty.h"
#include "models/friction/prepared_map.h"

namespace warmjoint::inline identification {
namespace {

constexpr double kChance = 6.63;  // why 6.63: chi-squared of one degree of freedom, 1 %

/// Mean square of the residual, (N.m)^2 or N^2.
double MeanSquare(const NormalEquations& normal, const Eigen::VectorXd& x, Eigen::Index samples) {
  const double sum = normal.squares - 2 * x.dot(normal.product) + x.dot(normal.gram * x);
  return std::max(sum, 0.0) / static_cast<double>(samples);
}

/// Linear conditions on the unknowns: rows x = values.
struct Conditions {
  Eigen::MatrixXd rows;    // [k x d], independent of each other
  Eigen::VectorXd values;  // [k]
};

/// gram x = product under conditions, by the projection onto what they leave.
class Conditioned {
 public:
  Conditioned(const Eigen::MatrixXd& gram, Conditions conditions)
      : conditions_(std::move(conditions)), firm_(gram.diagonal().mean()), held_(gram) {
    const Eigen::MatrixXd& rows = conditions_.rows;
    if (rows.rows() == 0) return;
    // what the conditions fix gets a firm diagonal, which changes nothing where they hold
    held_.compute(gram + firm_ * rows.transpose() * rows);
    along_ = held_.solve(rows.transpose());
    small_.compute(rows * along_);
  }
  bool works() const { return held_.info() == Eigen::Success; }

  Eigen::VectorXd Solve(const Eigen::VectorXd& product) const {
    const auto& [rows, values] = conditions_;
    if (rows.rows() == 0) return held_.solve(product);
    const Eigen::VectorXd x = held_.solve(product + firm_ * rows.transpose() * values);
    return x - along_ * small_.solve(rows * x - values);
  }

  /// [d x d] of rank d - k.
  Eigen::MatrixXd Inverse() const {
    const Eigen::Index d = held_.rows();
    const Eigen::MatrixXd whole = held_.solve(Eigen::MatrixXd::Identity(d, d));
    if (conditions_.rows.rows() == 0) return whole;
    return whole - along_ * small_.solve(along_.transpose());
  }

 private:
  Conditions conditions_;
  double firm_;
  Eigen::LLT<Eigen::MatrixXd> held_;
  Eigen::MatrixXd along_;               // [d x k]
  Eigen::LDLT<Eigen::MatrixXd> small_;  // [k x k]
};

/// Shares out what law and maps both can be: see FitMaps. gram: normal's with the prior; plain: solves it.
Conditions Centre(const MapProblem& problem, const NormalEquations& normal,
                  const Eigen::MatrixXd& gram, const Conditioned& plain) {
  const Eigen::Index d = gram.rows(), free = problem.free.cols();
  const std::vector<Eigen::Index> shared = ImitatedLaw(normal.gram, free, problem.lower);
  const auto count = static_cast<Eigen::Index>(shared.size());
  Conditions conditions{Eigen::MatrixXd::Zero(count, d), Eigen::VectorXd::Zero(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    conditions.rows.row(i).tail(d - free) =
        normal.gram.row(shared[static_cast<size_t>(i)]).tail(d - free).normalized();
  }
  if (count == 0) return conditions;

  // a bound costs nothing where the fit without conditions is on its other side, or as far off as noise puts it
  const Eigen::VectorXd x = plain.Solve(normal.product);
  const Conditioned centred(gram, conditions);
  if (!centred.works()) return conditions;
  const Eigen::VectorXd after = centred.Solve(normal.product);
  const double noise = MeanSquare(normal, x, problem.torque.size());
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Index j = shared[static_cast<size_t>(i)];
    const double bound = problem.lower[static_cast<size_t>(j)];
    if (after[j] >= bound) continue;
    const double below = std::max(0.0, bound - x[j]);
    const double variance = noise * plain.Solve(Eigen::VectorXd::Unit(d, j))[j];
    if (below * below > kChance * variance) continue;
    conditions.rows.row(i) = Eigen::RowVectorXd::Unit(d, j);
    conditions.values[i] = bound;
  }
  return conditions;
}

}  // namespace

NormalEquations NormalOf(const MapProblem& problem) {
  if (problem.rows) return problem.rows->Normal(problem.free, problem.torque);
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
  const Conditioned plain(gram, {Eigen::MatrixXd(0, d), {}});
  if (!std::isfinite(normal.squares) || !plain.works()) return std::nullopt;
  const Conditioned centred(gram, Centre(problem, normal, gram, plain));
  if (!centred.works()) return std::nullopt;
  fit.x = centred.Solve(normal.product);
  if (!fit.x.allFinite()) return std::nullopt;
  fit.inverse = centred.Inverse();
  fit.effective = fit.inverse.cwiseProduct(fit.gram).sum();

  fit.maps = WithWeights(problem.maps, fit.x.tail(d - fit.free));
  fit.fitted = problem.free * fit.x.head(fit.free);
  fit.fitted += problem.rows ? problem.rows->Times(fit.x.tail(d - fit.free))
                             : EvaluateMaps(fit.maps, problem.points);
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

Eigen::VectorXd EvaluateMaps(const std::vector<FrictionMap>& maps, const MapPoints& points) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(points.rows());
  for (const FrictionMap& map : maps) {
    const PreparedMap ready(map);
    for (Eigen::Index i = 0; i < sum.size(); ++i) sum[i] += ready.Value(PointAt(points, i));
  }
  return sum;
}

}  // namespace warmjoint::inline identification
