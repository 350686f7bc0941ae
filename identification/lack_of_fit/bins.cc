#include "identification/lack_of_fit/bins.h"

#include <algorithm>

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr Index kBins = 400;
constexpr Index kInHold = 8;      // bins within a segment
constexpr Index kInHolds = 8000;  // bins within all segments together, but at least two in each

/// A stretch of samples that belong to one segment of the selection, or to none.
struct Stretch {
  Index end = 0;       // one past its last sample
  Index segment = -1;  // -1: none
};

/// The stretch that a sample lies in. next: the number of segments that end before it, which is counted on.
Stretch StretchAt(Index sample, Index samples, const std::vector<Segment>& segments, Index& next) {
  const auto count = static_cast<Index>(segments.size());
  const auto at = [&](Index i) -> const Segment& { return segments[static_cast<size_t>(i)]; };
  while (next < count && at(next).end <= sample) ++next;
  if (next == count) return {samples, -1};
  if (sample < at(next).begin) return {at(next).begin, -1};
  return {at(next).end, next};
}

Index Length(const Segment& segment) { return segment.end - segment.begin; }

/// The place of a bin's samples within their segment, from 0 to 1.
double PhaseOf(Index begin, Index end, const Segment& one) {
  const double middle = 0.5 * static_cast<double>(begin + end);
  return (middle - static_cast<double>(one.begin)) / static_cast<double>(Length(one));
}

/// Fills in the weights, times and mean velocities of bins.
void Describe(const LogSamples& measurements, Bins& bins) {
  const auto m = static_cast<Index>(bins.begin.size());
  const Eigen::VectorXd& t = measurements.time;
  const double duration = t[t.size() - 1] - t[0];
  bins.weight.resize(m);
  bins.time.resize(m);
  for (Index c = 0; c < m; ++c) {
    const auto i = static_cast<size_t>(c);
    bins.weight[c] = static_cast<double>(bins.end[i] - bins.begin[i]);
    bins.time[c] = (0.5 * (t[bins.begin[i]] + t[bins.end[i] - 1]) - t[0]) / duration;
  }
  bins.velocity = bins.Means(measurements.velocity);
}

/// Neighbours that belong together, as many of them as `parts` of a segment leave, and no more than a 400th
/// of all. parts: 1 or more.
Bins Gather(const LogSamples& measurements, const Selection& selection, Index parts) {
  const Eigen::VectorXd& v = measurements.velocity;
  const std::vector<Segment>& segments = selection.segments;
  const auto at = [&](Index i) -> const Segment& { return segments[static_cast<size_t>(i)]; };
  const Index share = 1 + selection.count() / kBins;

  // each kept sample begins a bin, which those after it join as long as they belong to it
  Bins bins;
  std::vector<double> holds, phases;
  const bool *keep = selection.keep.data(), *all_end = keep + v.size();
  Index next = 0, kept_until = 0;
  for (Index i = 0; i < v.size();) {
    // the next run of kept samples
    if (i >= kept_until) {
      const bool* kept = std::find(keep + i, all_end, true);
      i = kept - keep;
      kept_until = std::find(kept, all_end, false) - keep;
      if (kept == all_end) break;
    }
    // a bin has at most its share of all samples, and of its segment
    const Index first = i;
    const auto [end, index] = StretchAt(first, v.size(), segments, next);
    const Index most = index < 0 ? share : std::min(share, (Length(at(index)) + parts - 1) / parts);
    const Index last = std::min({first + most, end, kept_until});
    i = last;
    // where no segments are known, samples of one direction belong together
    if (segments.empty()) {
      i = first + 1;
      while (i < last && v[first] * v[i] > 0) ++i;
    }
    bins.begin.push_back(first);
    bins.end.push_back(i);
    if (segments.empty()) continue;
    holds.push_back(static_cast<double>(index));
    phases.push_back(PhaseOf(first, i, at(std::max(index, Index{0}))));
  }
  bins.hold = Eigen::Map<const Eigen::VectorXd>(holds.data(), static_cast<Index>(holds.size()));
  bins.phase = Eigen::Map<const Eigen::VectorXd>(phases.data(), static_cast<Index>(phases.size()));
  Describe(measurements, bins);
  return bins;
}

/// Means of C columns from `column` on. all: [N x c]; keep: as Means; means: [m x c]
template <int C>
void WriteMeans(const Bins& bins, const Eigen::Ref<const Eigen::MatrixXd>& all, const bool* keep,
                Index column, Eigen::MatrixXd& means) {
  const Index stride = all.outerStride();
  const double* values = all.data() + column * stride;
  for (Index c = 0; c < bins.size(); ++c) {
    const Index begin = bins.begin[static_cast<size_t>(c)], end = bins.end[static_cast<size_t>(c)];
    double sums[C] = {};
    for (Index n = begin; n < end; ++n) {
      if (keep && !keep[n]) continue;
      for (int k = 0; k < C; ++k) sums[k] += values[n + k * stride];
    }
    for (int k = 0; k < C; ++k) means(c, column + k) = sums[k] / bins.weight[c];
  }
}

}  // namespace

Bins MakeBins(const LogSamples& measurements, const Selection& selection) {
  return Gather(measurements, selection, 1);
}

Bins BinsWithinHolds(const LogSamples& measurements, const Selection& selection) {
  const auto holds = static_cast<Index>(selection.segments.size());
  const Index parts = std::clamp(kInHolds / std::max<Index>(holds, 1), Index{2}, kInHold);
  return Gather(measurements, selection, parts);
}

Eigen::MatrixXd Bins::Means(const Eigen::Ref<const Eigen::MatrixXd>& all, const bool* keep) const {
  Eigen::MatrixXd means(size(), all.cols());
  // four columns in one pass, so that a bin's few samples cost no loop each
  Index column = 0;
  for (; column + 4 <= all.cols(); column += 4) WriteMeans<4>(*this, all, keep, column, means);
  for (; column < all.cols(); ++column) WriteMeans<1>(*this, all, keep, column, means);
  return means;
}

void Bins::TakeOff(const Eigen::VectorXd& numbers, Eigen::VectorXd& all) const {
  for (Index c = 0; c < size(); ++c) {
    const auto i = static_cast<size_t>(c);
    all.segment(begin[i], end[i] - begin[i]).array() -= numbers[c];
  }
}

}  // namespace warmjoint
