#include "identification/maps/map_system.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "identification/maps/holes.h"
#include "identification/maps/imitated_columns.h"
#include "identification/uncertainty/tails.h"

namespace warmjoint {
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

MapSystem::Bounds MapSystem::Bounded(const NormalEquations& normal) const {
  Bounds bounds{deviating_->conditions(), {}};
  auto& [rows, values] = bounds.conditions;
  const Eigen::VectorXd after = deviating_->Solve(normal.product);
  Eigen::VectorXd x;
  // every bound of a column that the fit would cross
  for (size_t j = 0; j < lower_.size(); ++j) {
    const auto at = static_cast<Eigen::Index>(j);
    if (after[at] >= lower_[j]) continue;

    // a bound costs nothing where the fit without conditions is on its other side, or as far off as noise puts it
    if (x.size() == 0) x = plain_->Solve(normal.product);
    const double noise = std::max(normal.Squares(x), 0.0) / static_cast<double>(normal.rows);
    const double below = std::max(0.0, lower_[j] - x[at]);
    const double variance = noise * plain_->Solve(Eigen::VectorXd::Unit(after.size(), at))[at];
    const auto shared = std::ranges::find(shared_, at);
    // within its interval, where the data tell one
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
    values[row] = lower_[j];
  }
  return bounds;
}

Eigen::MatrixXd MapSystem::Inverse() const {
  const auto& [rows, values] = latest_->conditions();
  const auto shared = static_cast<Eigen::Index>(shared_.size());
  if (rows.rows() == shared) return latest_->Inverse();
  return Conditioned(gram_, {rows.topRows(shared), values.head(shared)}).Inverse();
}

std::optional<Eigen::VectorXd> MapSystem::Solve(const NormalEquations& normal) {
  if (!std::isfinite(normal.squares) || !plain_->works() || !deviating_->works()) {
    return std::nullopt;
  }
  const Bounds bounds = Bounded(normal);
  // the factors of the latest bounds serve again as long as the same ones hold
  if (bounds.columns.empty()) {
    latest_ = deviating_;
  } else if (!latest_ || latest_->conditions() != bounds.conditions) {
    latest_ = std::make_shared<const Conditioned>(gram_, bounds.conditions);
  }
  if (!latest_->works()) return std::nullopt;
  Eigen::VectorXd x = latest_->Solve(normal.product);
  // at the bound, not beside it by rounding
  for (const Eigen::Index j : bounds.columns) x[j] = lower_[static_cast<size_t>(j)];
  return x.allFinite() ? std::optional(x) : std::nullopt;
}

}  // namespace warmjoint
