#include "identification/lack_of_fit/bins.h"

#include <algorithm>
#include <cmath>

namespace warmjoint::inline identification {
namespace {

using Eigen::Index;

constexpr Index kBins = 400;
constexpr double kOneSpeed = 0.02;  // relative
constexpr Index kInHold = 8;        // bins within a segment
constexpr Index kInHolds = 8000;    // bins within all of them, but two in each at least

/// The segment that each sample belongs to, -1 for none; empty where no segments are known. [N]
Eigen::ArrayXi SegmentOf(Index samples, const Selection& selection) {
  if (selection.segments.empty()) return {};
  Eigen::ArrayXi segment = Eigen::ArrayXi::Constant(samples, -1);
  for (size_t s = 0; s < selection.segments.size(); ++s) {
    const Segment& one = selection.segments[s];
    segment.segment(one.begin, one.end - one.begin) = static_cast<int>(s);
  }
  return segment;
}

/// Where each bin stands in its segment. segment: [N]
void Place(const Eigen::ArrayXi& segment, const Selection& selection, Bins& bins) {
  bins.hold.resize(bins.size());
  bins.phase.resize(bins.size());
  for (Index c = 0; c < bins.size(); ++c) {
    const auto i = static_cast<size_t>(c);
    const int index = segment[bins.begin[i]];
    bins.hold[c] = index;
    const Segment& one = selection.segments[static_cast<size_t>(std::max(index, 0))];
    const double middle = 0.5 * static_cast<double>(bins.begin[i] + bins.end[i]);
    bins.phase[c] =
        (middle - static_cast<double>(one.begin)) / static_cast<double>(one.end - one.begin);
  }
}

/// Neighbours that belong together, as many of them as `parts` of a segment leave, and no more than a 400th
/// of all. parts: 1 or more.
Bins Gather(const Measurements& measurements, const Selection& selection, Index parts) {
  const Eigen::VectorXd& v = measurements.velocity;
  const Eigen::ArrayXi segment = SegmentOf(v.size(), selection);
  const Index share = 1 + selection.count() / kBins;
  // the most samples of a bin: its share of all, and of its segment where one is known
  const auto most = [&](Index first) {
    if (segment.size() == 0 || segment[first] < 0) return share;
    const Segment& one = selection.segments[static_cast<size_t>(segment[first])];
    return std::min(share, (one.end - one.begin + parts - 1) / parts);
  };
  // samples of one segment are alike, else those of one direction or at about one speed
  const auto together = [&](Index first, Index other) {
    if (segment.size() > 0) return segment[first] == segment[other];
    if (measurements.acceleration) return v[first] * v[other] > 0;
    return std::abs(v[other] - v[first]) <= kOneSpeed * std::abs(v[first]);
  };

  // each kept sample joins the bin before it or begins one of its own
  Bins bins;
  bins.begin.reserve(static_cast<size_t>(v.size()));
  bins.end.reserve(static_cast<size_t>(v.size()));
  Index first = -1, end = -1, longest = 0;  // of the present bin
  for (Index i = 0; i < v.size(); ++i) {
    if (!selection.keep[i]) continue;
    if (end == i && i - first < longest && together(first, i)) {
      end = i + 1;
      continue;
    }
    if (first >= 0) bins.end.push_back(end);
    bins.begin.push_back(i);
    first = i;
    end = i + 1;
    longest = most(i);
  }
  if (first >= 0) bins.end.push_back(end);

  // where they stand
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
  bins.velocity = bins.Means(v);
  if (segment.size() > 0) Place(segment, selection, bins);
  return bins;
}

/// Means of C columns from `column` on. all: [N x c]; means: [m x c]
template <int C>
void WriteMeans(const Bins& bins, const Eigen::Ref<const Eigen::MatrixXd>& all, Index column,
                Eigen::MatrixXd& means) {
  const Index stride = all.outerStride();
  const double* values = all.data() + column * stride;
  for (Index c = 0; c < bins.size(); ++c) {
    const Index begin = bins.begin[static_cast<size_t>(c)], end = bins.end[static_cast<size_t>(c)];
    double sums[C] = {};
    for (Index n = begin; n < end; ++n) {
      for (int k = 0; k < C; ++k) sums[k] += values[n + k * stride];
    }
    for (int k = 0; k < C; ++k) means(c, column + k) = sums[k] / static_cast<double>(end - begin);
  }
}

}  // namespace

Bins MakeBins(const Measurements& measurements, const Selection& selection) {
  return Gather(measurements, selection, 1);
}

Bins BinsWithinHolds(const Measurements& measurements, const Selection& selection) {
  const auto holds = static_cast<Index>(selection.segments.size());
  const Index parts = std::clamp(kInHolds / std::max<Index>(holds, 1), Index{2}, kInHold);
  return Gather(measurements, selection, parts);
}

Eigen::MatrixXd Bins::Means(const Eigen::Ref<const Eigen::MatrixXd>& all) const {
  Eigen::MatrixXd means(size(), all.cols());
  // four columns in one pass, so that a bin's few samples cost no loop each
  Index column = 0;
  for (; column + 4 <= all.cols(); column += 4) WriteMeans<4>(*this, all, column, means);
  for (; column < all.cols(); ++column) WriteMeans<1>(*this, all, column, means);
  return means;
}

}  // namespace warmjoint::inline identification
