#include "identification/lack_of_fit/lag.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "models/foundation/robust_noise.h"

namespace warmjoint::inline identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kFewestRows = 40;
constexpr int kLags = 14;     // time constants that are tried
constexpr Index kSingle = 4;  // samples of a segment that stay by themselves

/// Runs of samples that follow a change of friction.
struct Followers {
  std::vector<Index> begin, end;  // samples of each row
  std::vector<double> weight;     // samples kept
  std::vector<double> since;      // s since the segment began
  std::vector<double> drop;       // F0 - F1, N.m or N
  VectorXd holds;                 // durations of the segments, s

  Index rows() const { return static_cast<Index>(begin.size()); }
};

/// Means over the kept samples of each row. column: [N]
VectorXd Means(const Followers& followers, const Selection& selection, const auto& column) {
  VectorXd means(followers.rows());
  for (Index row = 0; row < followers.rows(); ++row) {
    const auto r = static_cast<size_t>(row);
    double sum = 0;
    for (Index i = followers.begin[r]; i < followers.end[r]; ++i) {
      if (selection.keep[i]) sum += column[i];
    }
    means[row] = sum / followers.weight[r];
  }
  return means;
}

/// The rows of one segment: single samples first, then runs that grow by half.
void AddSegment(const Segment& segment, double drop, const VectorXd& time,
                const Selection& selection, Followers& followers) {
  Index begin = segment.begin;
  while (begin < segment.end) {
    // the further from the change, the longer the runs: half of what has passed
    const Index passed = begin - segment.begin;
    const Index end = std::min(begin + std::max<Index>(1, (passed - kSingle) / 2), segment.end);
    // kept samples alone count, at their mean time since the change
    double kept = 0, since = 0;
    for (Index i = begin; i < end; ++i) {
      if (!selection.keep[i]) continue;
      kept += 1;
      since += time[i] - time[segment.begin];
    }
    if (kept > 0) {
      followers.begin.push_back(begin);
      followers.end.push_back(end);
      followers.weight.push_back(kept);
      followers.since.push_back(since / kept);
      followers.drop.push_back(drop);
    }
    begin = end;
  }
}

/// Segments that follow another one after less than that one's duration. friction: [N] of the fit
Followers AfterChanges(const VectorXd& friction, const VectorXd& time, const Selection& selection) {
  Followers followers;
  std::vector<double> holds;
  for (size_t s = 1; s < selection.segments.size(); ++s) {
    const Segment &before = selection.segments[s - 1], &after = selection.segments[s];
    const double pause = time[after.begin] - time[before.end - 1];
    const double held = time[before.end - 1] - time[before.begin];
    if (pause > std::max(held, 2 * (time[before.begin + 1] - time[before.begin]))) continue;
    AddSegment(after, friction[before.end - 1] - friction[after.begin], time, selection, followers);
    holds.push_back(time[after.end - 1] - time[after.begin]);
  }
  followers.holds = Eigen::Map<const VectorXd>(holds.data(), static_cast<Index>(holds.size()));
  return followers;
}

/// Time constants to try, s, the same ratio apart.
VectorXd TimeConstants(double step, double hold) {
  const double shortest = step / 8, longest = std::max(0.5 * hold, step);
  return VectorXd::LinSpaced(kLags, std::log(shortest), std::log(longest)).array().exp();
}

/// (F0 - F1) exp(-t/T), a column for each T.
SharedColumns Decays(const Followers& followers, const VectorXd& lags) {
  // rows of different segments share their times
  std::vector<double> times = followers.since;
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  SharedColumns decays;
  for (const double since : followers.since) {
    decays.place.push_back(std::ranges::lower_bound(times, since) - times.begin());
  }

  // what is left after each time, of each row's drop
  const Eigen::Map<const Eigen::ArrayXd> since(times.data(), static_cast<Index>(times.size()));
  decays.shares.resize(since.size(), lags.size());
  for (Index k = 0; k < lags.size(); ++k) decays.shares.col(k) = (-since / lags[k]).exp();
  decays.factor = Eigen::Map<const VectorXd>(followers.drop.data(), followers.rows());
  return decays;
}

}  // namespace

Finding TestLag(const FittedModel& model, const Measurements& measurements, VectorXd& residual,
                ErrorLevel& level) {
  Finding finding;
  finding.test = &LagTest();
  finding.reason = finding.test->absent;
  const Selection& selection = model.selection;
  if (selection.segments.size() < 2) return finding;
  const VectorXd friction = model.torque - model.residual;
  Followers followers = AfterChanges(friction, measurements.time, selection);
  if (followers.rows() < kFewestRows) return finding;

  // the decay that explains most beside the fit
  const VectorXd left = Means(followers, selection, residual);
  MatrixXd derivatives(followers.rows(), model.derivatives.cols());
  for (Index j = 0; j < derivatives.cols(); ++j) {
    derivatives.col(j) = Means(followers, selection, model.derivatives.col(j));
  }
  const Eigen::Map<const VectorXd> weight(followers.weight.data(), followers.rows());
  const Selection all{Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(followers.rows(), true), {}};
  GrowingFit fit(weight, left, derivatives, all);
  const double step = MedianStep(measurements.time);
  const VectorXd lags = TimeConstants(step, MedianInPlace(followers.holds));
  const SharedColumns decays = Decays(followers, lags);
  Index best = 0;
  fit.ExplainedBy(decays).maxCoeff(&best);
  const Features decay{decays.Column(best), kLags};
  const AskedFeatures asked = fit.Ask({decay});
  fit.LearnNoise(asked);
  finding = fit.Test(asked, 0);
  finding.test = &LagTest();

  // a lag leaves a share of what was before, not of what comes: the test has one side
  const double share = fit.CoefficientOf(decay.columns);
  if (share <= 0 || finding.explained <= 0) finding.p = 1;
  finding.p_adjusted = level.Adjusted(finding.p);
  if (!level.Rejects(finding.p)) return finding;
  finding.rejected = true;
  // the area under what is left, summed over the samples
  finding.lag = share * step / (1 - std::exp(-step / lags[best]));

  // taken off the residual
  fit.Take(decay);
  const VectorXd explained = fit.Explained();
  for (Index row = 0; row < followers.rows(); ++row) {
    const auto r = static_cast<size_t>(row);
    residual.segment(followers.begin[r], followers.end[r] - followers.begin[r]).array() -=
        explained[row];
  }
  return finding;
}

}  // namespace warmjoint::inline identification
