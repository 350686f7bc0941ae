#include "identification/answer/settling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// why: that all comparisons of a run agree happens by chance far less often than their bound allows: with 0.01 in none
// of 27,000 logs of white and of coloured noise
constexpr double kLevel = 0.1;
constexpr Index kMostOfSegment =
    4;  // a quarter of it; why: as much from its middle on is left to compare with
constexpr Index kShortest = 8;  // samples of a segment; why: a quarter of fewer is one sample

/// A sum of terms whose signs are random where the torque has settled.
struct SignedSum {
  double sum = 0, squares = 0;

  void Add(double term) {
    sum += term;
    squares += term * term;
  }
  double x() const { return squares > 0 ? sum / std::sqrt(squares) : 0; }
};

/// The evidence for a torque that has not settled, of one run next to a change of speed.
struct Unsettled {
  std::array<SignedSum, 2> larger;  // than from the middle on, than beyond the change
  std::array<SignedSum, 3> along;  // the change of speed, beyond a force or a friction of the place

  /// z: mean of the run; r: from the middle on; p: at the other side of the change; sign: of the change of speed
  void Add(double z, double r, double p, double sign) {
    larger[0].Add(z * z - r * r);
    larger[1].Add(z * z - p * p);
    along[0].Add(sign * (z - r));
    along[1].Add(sign * (z - p));
    along[2].Add(sign * (z + p));
  }

  /// The evidence of the stronger kind; the evidence of a kind is the least of its comparisons.
  double x() const {
    const double by_size = std::min(larger[0].x(), larger[1].x());
    const auto [least, most] = std::minmax({along[0].x(), along[1].x(), along[2].x()});
    return std::max({by_size, least, -most});
  }
};

/// Means of a residual over kept samples.
class RunMeans {
 public:
  RunMeans(const Selection& used, const VectorXd& residual)
      : count_(VectorXd::Zero(used.keep.size() + 1)), sum_(count_) {
    Index n = 0;
    for (Index i = 0; i < used.keep.size(); ++i) {
      count_[i + 1] = count_[i] + used.keep[i];
      sum_[i + 1] = sum_[i] + (used.keep[i] ? residual[n++] : 0);
    }
  }

  /// Of the samples first <= i < last; nothing where none is kept.
  std::optional<double> Of(Index first, Index last) const {
    const double count = count_[last] - count_[first];
    if (count == 0) return std::nullopt;
    return (sum_[last] - sum_[first]) / count;
  }

 private:
  VectorXd count_, sum_;  // [N + 1] of the samples before
};

/// Where runs begin and end, in samples from the change of speed on: single ones first, then runs that grow by half.
std::vector<Index> EdgesOfRuns(Index most) {
  std::vector<Index> edges{0};
  while (edges.back() < most) {
    const Index last = edges.back();
    edges.push_back(std::min(last + std::max<Index>(1, last / 2), most));
  }
  return edges;
}

Index Length(const Segment& segment) { return segment.end - segment.begin; }

/// The evidence of each run before and after the changes of speed of all segments, counted from the change on. edges: [runs + 1]
struct BesideChanges {
  std::vector<Unsettled> behind, before;

  BesideChanges(const Selection& used, const RunMeans& means, const std::vector<Index>& edges)
      : behind(edges.size() - 1), before(edges.size() - 1) {
    for (std::size_t k = 1; k < used.segments.size(); ++k) {
      const Segment &one = used.segments[k - 1], &next = used.segments[k];
      const Index reach = std::min(Length(one), Length(next)) / kMostOfSegment;
      const double sign = next.velocity > one.velocity ? 1 : -1;
      for (std::size_t i = 0; i < behind.size() && edges[i + 1] <= reach; ++i) {
        const auto after_change = means.Of(next.begin + edges[i], next.begin + edges[i + 1]);
        const auto until_change = means.Of(one.end - edges[i + 1], one.end - edges[i]);
        if (!after_change || !until_change) continue;
        const auto middle = [&](const Segment& segment) {
          const Index at = (segment.begin + segment.end) / 2;
          return means.Of(at + edges[i], at + edges[i + 1]);
        };
        if (const auto r = middle(next)) behind[i].Add(*after_change, *r, *until_change, sign);
        if (const auto r = middle(one)) before[i].Add(*until_change, *r, *after_change, sign);
      }
    }
  }
};

/// The number of runs from the change on that have not settled, where one settled run between them is tolerated.
std::size_t UnsettledRuns(const std::vector<Unsettled>& runs, double beyond_chance) {
  std::size_t unsettled = 0;
  for (std::size_t i = 0; i < runs.size() && i <= unsettled + 1; ++i) {
    if (runs[i].x() > beyond_chance) unsettled = i + 1;
  }
  return unsettled;
}

/// Median number of samples of the segments.
Index TypicalLength(const Selection& used) {
  std::vector<double> lengths;
  for (const Segment& segment : used.segments) {
    lengths.push_back(static_cast<double>(Length(segment)));
  }
  return static_cast<Index>(MedianOf(lengths));
}

/// The duration of these runs and of the next one, in which what is left fades away, s; 0 where there are none or no end is seen.
double TimeOf(const std::vector<Unsettled>& runs, double beyond_chance,
              const std::vector<Index>& edges, double step) {
  const std::size_t unsettled = UnsettledRuns(runs, beyond_chance);
  if (unsettled == 0 || unsettled + 1 >= edges.size()) return 0;
  return static_cast<double>(edges[unsettled + 1]) * step;
}

}  // namespace

bool MaySettle(const Settling& settling, const Selection& used, const VectorXd& time) {
  // a torque that only fades after a change of speed, or only before one, may take any time for it
  if (settling.after == 0 || settling.before == 0) return true;
  const double typical = static_cast<double>(TypicalLength(used)) * MedianStep(time);
  return settling.after + settling.before <= 0.5 * typical;
}

Settling SettlingTime(const Selection& used, const VectorXd& time, const VectorXd& residual) {
  if (used.segments.size() < 2) return {};
  const Index typical = TypicalLength(used);
  if (typical < kShortest) return {};
  const std::vector<Index> edges = EdgesOfRuns(typical / kMostOfSegment);
  const BesideChanges beside(used, RunMeans(used, residual), edges);

  // two kinds of evidence with two signs, in each of the runs on either side
  const double trials = 8 * static_cast<double>(beside.behind.size());
  const double beyond_chance = std::sqrt(2 * std::log(trials / kLevel));
  const double step = MedianStep(time);
  return {TimeOf(beside.behind, beyond_chance, edges, step),
          TimeOf(beside.before, beyond_chance, edges, step)};
}

Selection WithoutSettling(Selection selection, const VectorXd& time, const Settling& settling) {
  constexpr double rounding = 1e-9;  // s, of time stamps
  std::vector<Segment> left;
  for (Segment segment : selection.segments) {
    const double until = time[segment.begin] + settling.after - rounding;
    for (; segment.begin < segment.end && time[segment.begin] < until; ++segment.begin) {
      selection.keep[segment.begin] = false;
    }
    if (segment.begin == segment.end) continue;
    const double from = time[segment.end - 1] - settling.before + rounding;
    for (; segment.begin < segment.end && time[segment.end - 1] > from; --segment.end) {
      selection.keep[segment.end - 1] = false;
    }
    if (segment.begin < segment.end) left.push_back(segment);
  }
  selection.segments = std::move(left);
  return selection;
}

}  // namespace warmjoint
