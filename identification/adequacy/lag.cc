#include "identification/adequacy/lag.h"

#include <array>
#include <cmath>
#include <vector>

#include "identification/adequacy/growing_fit.h"
#include "identification/linear/fit_gravity.h"
#include "identification/linear/least_squares.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint::inline identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kChange = 0.2;  // of the friction, rms, from one sample to the next
constexpr double kStep = 0.05;   // of the largest speed, from one sample to the next
constexpr Index kFewestRows = 40;
constexpr double kGlimpse = 3;   // deviations
constexpr double kFirst = 0.05;  // share that the first span of a lag keeps, at least
constexpr double kSame = 1e-9;   // columns that count as the same
constexpr std::array<Index, 6> kSpan{0, 1, 2, 4, 8, 16};  // samples since the change

/// Samples that follow a change of speed.
struct Followers {
  std::vector<Index> rows;   // of the recording
  std::vector<Index> since;  // samples since the change, 0 to 15
  std::vector<double> drop;  // F0 - F1, N.m or N
};

/// friction: [N] of the fit, N.m or N
Followers AfterChanges(const VectorXd& friction, const VectorXd& velocity,
                       const Selection& selection) {
  const double change = kChange * friction.norm() / std::sqrt(static_cast<double>(friction.size()));
  const double step = kStep * velocity.cwiseAbs().maxCoeff();
  Followers followers;
  Index since = kSpan.back();
  double before = 0;
  for (Index i = 1; i < friction.size(); ++i, ++since) {
    const bool moved = std::abs(velocity[i] - velocity[i - 1]) > step;
    if (moved && std::abs(friction[i] - friction[i - 1]) > change) {
      // a ramp is one change from its beginning on
      if (since > 0) before = friction[i - 1];
      since = 0;
    }
    if (since >= kSpan.back() || !selection.keep[i]) continue;
    followers.rows.push_back(i);
    followers.since.push_back(since);
    followers.drop.push_back(before - friction[i]);
  }
  return followers;
}

/// F0 - F1 in the column of its span. [n x 5]
MatrixXd Features(const Followers& followers) {
  const auto n = static_cast<Index>(followers.rows.size());
  MatrixXd features = MatrixXd::Zero(n, static_cast<Index>(kSpan.size()) - 1);
  for (Index row = 0; row < n; ++row) {
    const auto i = static_cast<size_t>(row);
    Index span = 0;
    while (followers.since[i] >= kSpan[static_cast<size_t>(span) + 1]) ++span;
    features(row, span) = followers.drop[i];
  }
  return features;
}

/// Whether the first span shows a share at all, as if nothing else were there: nearly always not.
bool MayLag(const MatrixXd& features, const VectorXd& left) {
  const auto first = features.col(0);
  const double variance = left.squaredNorm() / static_cast<double>(left.size());
  return first.dot(left) > kGlimpse * std::sqrt(first.squaredNorm() * variance);
}

}  // namespace

std::optional<Structure> FindLag(const FittedModel& model, const Measurements& measurements,
                                 VectorXd& residual) {
  const VectorXd friction = model.torque - model.residual;
  const Followers followers = AfterChanges(friction, measurements.velocity, model.selection);
  const auto n = static_cast<Index>(followers.rows.size());
  if (n < kFewestRows) return std::nullopt;
  const VectorXd left = residual(followers.rows);
  const Block lag{Dependence::lag, Features(followers)};
  if (!MayLag(lag.features, left)) return std::nullopt;
  const MatrixXd derivatives = model.derivatives(followers.rows, Eigen::all);
  const Selection all{Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(n, true), {}};
  GrowingFit fit(VectorXd::Ones(n), left, derivatives, all, {lag});
  std::optional<Structure> found = fit.Test(lag);
  if (!found) return std::nullopt;

  // what each span leaves beside the parameters
  const LeastSquares both = SolveLeastSquares(Beside(derivatives, lag.features), left, kSame);
  if (!both.mixed.empty()) return std::nullopt;
  const VectorXd share = both.solution.tail(lag.features.cols());
  if (share[0] < kFirst || share[0] < 0.5 * share.maxCoeff()) return std::nullopt;
  const VectorXd explained = lag.features * share;
  const double gone = left.squaredNorm() - (left - explained).squaredNorm();
  if (gone <= 0) return std::nullopt;
  for (Index row = 0; row < n; ++row) {
    residual[followers.rows[static_cast<size_t>(row)]] -= explained[row];
  }
  found->explained = gone;
  found->period = 0;
  for (Index s = 0; s < share.size(); ++s) {
    const auto i = static_cast<size_t>(s);
    found->period += share[s] * static_cast<double>(kSpan[i + 1] - kSpan[i]);
  }
  found->period *= MedianStep(measurements.time);
  found->moves = VectorXd();
  found->move_deviations = VectorXd();
  return found;
}

}  // namespace warmjoint::inline identification
