#include "identification/lack_of_fit/lag.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "identification/fit/fit_data.h"
#include "identification/lack_of_fit/bins.h"
#include "identification/lack_of_fit/growing_fit.h"
#include "identification/lack_of_fit/rows_by_value.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kFewestRows = 40;
constexpr int kLags = 14;  // time constants that are tried
// at most; why: a drive that is later than that cannot follow a motion
constexpr double kOfTheLog = 0.1;
constexpr Index kSingle = 4;  // samples of a segment that stay by themselves

/// Runs of samples that follow a change of friction.
struct Followers {
  Bins runs;                  // their weight: kept samples
  std::vector<double> since;  // [m] mean time since the segment began, s
  std::vector<double> drop;   // [m] F0 - F1, N.m or N
  std::vector<double> holds;  // durations of the segments, s
};

VectorXd AsVector(const std::vector<double>& numbers) {
  return Eigen::Map<const VectorXd>(numbers.data(), std::ssize(numbers));
}

/// The runs of one segment: single samples first, then runs that grow by half. weight: goes on
void AddSegment(const Segment& segment, double drop, const VectorXd& time,
                const Selection& selection, Followers& followers, std::vector<double>& weight) {
  Index begin = segment.begin;
  while (begin < segment.end) {
    // the further from the change, the longer the runs: half of what has passed
    const Index passed = begin - segment.begin;
    const Index end = std::min(begin + std::max<Index>(1, (passed - kSingle) / 2), segment.end);
    // only kept samples count, at their mean time since the change
    double kept = 0, since = 0;
    for (Index i = begin; i < end; ++i) {
      if (!selection.keep[i]) continue;
      kept += 1;
      since += time[i] - time[segment.begin];
    }
    if (kept > 0) {
      followers.runs.begin.push_back(begin);
      followers.runs.end.push_back(end);
      weight.push_back(kept);
      followers.since.push_back(since / kept);
      followers.drop.push_back(drop);
    }
    begin = end;
  }
}

/// Segments that follow another one after less than that one's duration. friction: [N] of the fit
Followers AfterChanges(const VectorXd& friction, const VectorXd& time, const Selection& selection) {
  Followers followers;
  std::vector<double> weight;
  for (size_t s = 1; s < selection.segments.size(); ++s) {
    const Segment &before = selection.segments[s - 1], &after = selection.segments[s];
    const double pause = time[after.begin] - time[before.end - 1];
    const double held = time[before.end - 1] - time[before.begin];
    if (pause > std::max(held, 2 * (time[before.begin + 1] - time[before.begin]))) continue;
    AddSegment(after, friction[before.end - 1] - friction[after.begin], time, selection, followers,
               weight);
    followers.holds.push_back(time[after.end - 1] - time[after.begin]);
  }
  followers.runs.weight = AsVector(weight);
  return followers;
}

/// Time constants to try, s, each the same multiple of the one before.
VectorXd TimeConstants(double step, double hold) {
  const double shortest = step / 8, longest = std::max(0.5 * hold, step);
  return VectorXd::LinSpaced(kLags, std::log(shortest), std::log(longest)).array().exp();
}

/// (F0 - F1) exp(-t/T), a column for each T. [rows x lags]
MatrixXd Decays(const Followers& followers, const VectorXd& lags) {
  const auto decay = [&](const Eigen::ArrayXd& since) -> MatrixXd {
    return (-since.matrix() * lags.cwiseInverse().transpose()).array().exp();
  };
  return AsVector(followers.drop).asDiagonal() * RowsByValue(AsVector(followers.since), decay);
}

}  // namespace

std::optional<Finding> TestLag(const LackOfFitTest&, const FittedModel& model, const LogSamples& m,
                               VectorXd& residual, ErrorLevel& level) {
  const Selection& selection = model.selection;
  if (selection.segments.size() < 2) return std::nullopt;
  const VectorXd friction = model.torque - model.residual;
  const Followers followers = AfterChanges(friction, m.time, selection);
  const Bins& runs = followers.runs;
  if (runs.size() < kFewestRows) return std::nullopt;

  // the decay that explains most in addition to the fit
  const bool* const keep = selection.keep.data();
  GrowingFit fit({runs.weight, runs.Means(model.derivatives, keep)}, runs.Means(residual, keep),
                 AllOf(runs.size()));
  const VectorXd lags = TimeConstants(model.step, MedianOf(followers.holds));
  const MatrixXd decays = Decays(followers, lags);
  Index best = 0;
  fit.ExplainedBy(decays).maxCoeff(&best);
  const Features decay{decays.col(best), kLags};
  fit.LearnNoise({decay});
  Finding finding = fit.Test(decay);

  // a lag leaves a positive share of the friction before the change, so the test has one side
  const double share = fit.CoefficientOf(decay.columns);
  // the area under what is left, summed over the samples; a longer time than kOfTheLog is not a lag
  finding.lag = share * model.step / (1 - std::exp(-model.step / lags[best]));
  const double longest = kOfTheLog * (m.time[m.size() - 1] - m.time[0]);
  if (share <= 0 || finding.explained <= 0 || finding.lag > longest) finding.p = 1;
  if (!level.Rejects(finding)) return finding;

  // taken off the residual
  fit.Take(decay);
  runs.TakeOff(fit.Explained(), residual);
  return finding;
}

}  // namespace warmjoint
