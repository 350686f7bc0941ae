#include "identification/lack_of_fit/lag.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "identification/lack_of_fit/growing_fit.h"
#include "identification/lack_of_fit/rows_by_value.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kFewestRows = 40;
constexpr int kLags = 14;     // time constants that are tried
constexpr Index kSingle = 4;  // samples of a segment that stay by themselves

/// A run of samples that follow a change of friction.
struct Follower {
  Index begin, end;  // samples
  double kept;       // of them
  double since;      // mean time since the segment began, s
  double drop;       // F0 - F1, N.m or N
};

struct Followers {
  std::vector<Follower> rows;
  std::vector<double> holds;  // durations of the segments, s

  Index size() const { return static_cast<Index>(rows.size()); }
  /// One number of each row.
  VectorXd Column(double Follower::*member) const {
    VectorXd column(size());
    std::ranges::transform(rows, column.begin(), member);
    return column;
  }
};

/// Means over the kept samples of each row, of C columns from `column` on. means: [rows x c]
template <int C>
void WriteMeans(const Followers& followers, const Selection& selection,
                const Eigen::Ref<const MatrixXd>& columns, Index column, MatrixXd& means) {
  const Index stride = columns.outerStride(), size = means.rows();
  const double* values = columns.data() + column * stride;
  double* mean = means.data() + column * size;
  for (const Follower& row : followers.rows) {
    // most rows are a kept sample by itself
    const bool single = row.end - row.begin == 1;
    double sums[C] = {};
    for (Index i = row.begin; i < row.end; ++i) {
      if (!single && !selection.keep[i]) continue;
      for (int k = 0; k < C; ++k) sums[k] += values[i + k * stride];
    }
    for (int k = 0; k < C; ++k) mean[k * size] = single ? sums[k] : sums[k] / row.kept;
    ++mean;
  }
}

/// Of all columns. columns: [N x c]; returns [rows x c].
MatrixXd Means(const Followers& followers, const Selection& selection,
               const Eigen::Ref<const MatrixXd>& columns) {
  MatrixXd means(followers.size(), columns.cols());
  // four columns in one pass, so that a row's few samples cost no loop each
  Index c = 0;
  for (; c + 4 <= columns.cols(); c += 4) WriteMeans<4>(followers, selection, columns, c, means);
  for (; c < columns.cols(); ++c) WriteMeans<1>(followers, selection, columns, c, means);
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
    if (kept > 0) followers.rows.push_back({begin, end, kept, since / kept, drop});
    begin = end;
  }
}

/// Segments that follow another one after less than that one's duration. friction: [N] of the fit
Followers AfterChanges(const VectorXd& friction, const VectorXd& time, const Selection& selection) {
  Followers followers;
  followers.rows.reserve(static_cast<size_t>(time.size()));
  for (size_t s = 1; s < selection.segments.size(); ++s) {
    const Segment &before = selection.segments[s - 1], &after = selection.segments[s];
    const double pause = time[after.begin] - time[before.end - 1];
    const double held = time[before.end - 1] - time[before.begin];
    if (pause > std::max(held, 2 * (time[before.begin + 1] - time[before.begin]))) continue;
    AddSegment(after, friction[before.end - 1] - friction[after.begin], time, selection, followers);
    followers.holds.push_back(time[after.end - 1] - time[after.begin]);
  }
  return followers;
}

/// Time constants to try, s, the same ratio apart.
VectorXd TimeConstants(double step, double hold) {
  const double shortest = step / 8, longest = std::max(0.5 * hold, step);
  return VectorXd::LinSpaced(kLags, std::log(shortest), std::log(longest)).array().exp();
}

/// (F0 - F1) exp(-t/T), a column for each T. [rows x lags]
MatrixXd Decays(const Followers& followers, const VectorXd& lags) {
  const auto decay = [&](const Eigen::ArrayXd& since) -> MatrixXd {
    return (-since.matrix() * lags.cwiseInverse().transpose()).array().exp();
  };
  return followers.Column(&Follower::drop).asDiagonal() *
         RowsByValue(followers.Column(&Follower::since), decay);
}

}  // namespace

std::optional<Finding> TestLag(const LackOfFitTest&, const FittedModel& model, const LogSamples& m,
                               VectorXd& residual, ErrorLevel& level) {
  const Selection& selection = model.selection;
  if (selection.segments.size() < 2) return std::nullopt;
  const VectorXd friction = model.torque - model.residual;
  const Followers followers = AfterChanges(friction, m.time, selection);
  if (followers.size() < kFewestRows) return std::nullopt;

  // the decay that explains most beside the fit
  const Selection all{Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(followers.size(), true), {}};
  GrowingFit fit(followers.Column(&Follower::kept), Means(followers, selection, residual),
                 Means(followers, selection, model.derivatives), all);
  VectorXd holds = Eigen::Map<const VectorXd>(followers.holds.data(),
                                              static_cast<Index>(followers.holds.size()));
  const VectorXd lags = TimeConstants(model.step, MedianInPlace(holds));
  const MatrixXd decays = Decays(followers, lags);
  Index best = 0;
  fit.ExplainedBy(decays).maxCoeff(&best);
  const Features decay{decays.col(best), kLags};
  fit.LearnNoise({decay});
  Finding finding = fit.Test(decay);

  // a lag leaves a share of what was before, not of what comes: the test has one side
  const double share = fit.CoefficientOf(decay.columns);
  if (share <= 0 || finding.explained <= 0) finding.p = 1;
  if (!level.Rejects(finding)) return finding;
  // the area under what is left, summed over the samples
  finding.lag = share * model.step / (1 - std::exp(-model.step / lags[best]));

  // taken off the residual
  fit.Take(decay);
  const VectorXd explained = fit.Explained();
  for (Index i = 0; i < followers.size(); ++i) {
    const Follower& row = followers.rows[static_cast<size_t>(i)];
    residual.segment(row.begin, row.end - row.begin).array() -= explained[i];
  }
  return finding;
}

}  // namespace warmjoint
