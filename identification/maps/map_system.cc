#include "identification/maps/map_system.h"

#include <algorithm>
#include <cmath>

#include "identification/maps/holes.h"
#include "identification/maps/imitated_columns.h"
#include "identification/uncertainty/tails.h"

namespace warmjoint::inline identification {
namespace {

/// Those under which the maps are what deviates from the columns `shared`.
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

}  // namespace

Conditioned::Conditioned(const Eigen::MatrixXd& gram, Conditions conditions)
    : conditions_(std::move(conditions)), firm_(gram.diagonal().mean()) {
  const Eigen::MatrixXd& rows = conditions_.rows;
  if (rows.rows() == 0) {
    held_.compute(gram);
    return;
  }
  // what the conditions fix gets a firm diagonal, which changes nothing where they hold
  held_.compute(gram + firm_ * rows.transpose() * rows);
  along_ = held_.solve(rows.transpose());
  small_.compute(rows * along_);
}

Eigen::VectorXd Conditioned::Solve(const Eigen::VectorXd& product) const {
  const auto& [rows, values] = conditions_;
  if (rows.rows() == 0) return held_.solve(product);
  const Eigen::VectorXd x = held_.solve(product + firm_ * rows.transpose() * values);
  return x - along_ * small_.solve(rows * x - values);
}

Eigen::MatrixXd Conditioned::Inverse() const {
  const Eigen::Index d = held_.rows();
  const Eigen::MatrixXd whole = held_.solve(Eigen::MatrixXd::Identity(d, d));
  if (conditions_.rows.rows() == 0) return whole;
  return whole - along_ * small_.solve(along_.transpose());
}

MapSystem::MapSystem(const std::vector<FrictionMap>& maps, const Eigen::MatrixXd& gram,
                     Eigen::Index free, double strength, const std::vector<bool>& unseen,
                     std::vector<double> lower)
    : gram_(gram), lower_(std::move(lower)), shared_(ImitatedLaw(gram, free, lower_)) {
  // where there are no data the neighbours tell more than the law alone
  const Eigen::Index q = gram.rows() - free;
  gram_.bottomRightCorner(q, q) += PenaltyOf(maps, gram.bottomRightCorner(q, q), unseen, strength);
  plain_ = std::make_shared<const Conditioned>(
      gram_, Conditions{Eigen::MatrixXd(0, gram.rows()), Eigen::VectorXd(0)});
  deviating_ = shared_.empty()
                   ? plain_
                   : std::make_shared<const Conditioned>(gram_, Deviating(gram, free, shared_));
}

std::optional<Conditions> MapSystem::Bounded(const NormalEquations& normal) const {
  Conditions conditions = deviating_->conditions();
  const Eigen::VectorXd after = deviating_->Solve(normal.product);
  Eigen::VectorXd x;
  bool bounded = false;
  // every bound of a shared column that the fit would cross
  for (size_t i = 0; i < shared_.size(); ++i) {
    const Eigen::Index j = shared_[i], d = after.size();
    const double bound = lower_[static_cast<size_t>(j)];
    if (after[j] >= bound) continue;

    // a bound costs nothing where the fit without conditions is on its other side, or as far off as noise puts it
    if (x.size() == 0) x = plain_->Solve(normal.product);
    const double noise = std::max(normal.Squares(x), 0.0) / static_cast<double>(normal.rows);
    const double below = std::max(0.0, bound - x[j]);
    const double variance = noise * plain_->Solve(Eigen::VectorXd::Unit(d, j))[j];
    if (below * below > kNoChance * variance) continue;
    conditions.rows.row(static_cast<Eigen::Index>(i)) = Eigen::RowVectorXd::Unit(d, j);
    conditions.values[static_cast<Eigen::Index>(i)] = bound;
    bounded = true;
  }
  return bounded ? std::optional(conditions) : std::nullopt;
}

std::optional<Eigen::VectorXd> MapSystem::Solve(const NormalEquations& normal) {
  if (!std::isfinite(normal.squares) || !plain_->works() || !deviating_->works()) {
    return std::nullopt;
  }
  const std::optional<Conditions> bounded = Bounded(normal);
  // the factors of the latest bounds serve again as long as the same ones hold
  if (!bounded) {
    latest_ = deviating_;
  } else if (!latest_ || latest_->conditions() != *bounded) {
    latest_ = std::make_shared<const Conditioned>(gram_, *bounded);
  }
  if (!latest_->works()) return std::nullopt;
  const Eigen::VectorXd x = latest_->Solve(normal.product);
  return x.allFinite() ? std::optional(x) : std::nullopt;
}

}  // namespace warmjoint::inline identification
