#include "identification/preparation/path_against_velocity.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "models/recording/sampling.h"

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr double kHarmless = 1e-3;  // of the path
constexpr double kCertain = 4;      // standard errors
constexpr double kNoMatter = 1e-4;  // of a way
constexpr int kFewest = 8;          // ways

/// The path since the first sample, as a function of time.
class Path {
 public:
  explicit Path(const Measurements& m) : m_(m), until_(m.size()) {
    until_[0] = 0;
    // path until each sample, its velocity held until the next
    for (Index i = 0; i + 1 < m.size(); ++i) {
      until_[i + 1] = until_[i] + std::abs(m.velocity[i]) * (m.time[i + 1] - m.time[i]);
    }
  }

  double At(double time) const {
    const double* begin = m_.time.data();
    const auto behind = std::upper_bound(begin, begin + m_.size(), time) - begin;
    // the path until the sample in front, and its velocity from there on
    const Index i = std::max<Index>(behind - 1, 0);
    return until_[i] + std::abs(m_.velocity[i]) * (time - m_.time[i]);
  }

  double Between(double from, double to) const { return At(to) - At(from); }

 private:
  const Measurements& m_;
  Eigen::VectorXd until_;  // [N] rad or m
};

bool IsBroken(const Measurements& m, Index first, Index last, double longest) {
  for (Index i = first; i < last; ++i) {
    if (m.time[i + 1] - m.time[i] > longest) return true;
    if (std::ranges::binary_search(m.starts, i + 1)) return true;
  }
  return false;
}

}  // namespace

std::optional<PathComparison> ComparePaths(const Measurements& by_velocity,
                                           const Measurements& by_position,
                                           const std::vector<Segment>& segments,
                                           const Measurements& taken) {
  const Path velocity(by_velocity), position(by_position);
  const double longest = LongestStep(taken.time);
  // a segment along which both columns tell the same way
  const auto is_same_speed = [&](const Segment& segment) {
    const double from = taken.time[segment.begin], to = taken.time[segment.end - 1];
    const double told = velocity.Between(from, to), way = position.Between(from, to);
    return std::abs(told - way) <= kSameSpeed * way;
  };
  const auto middle = [](const Segment& segment) { return (segment.begin + segment.end - 1) / 2; };

  // ways from the middle of a segment to that of the next, without gaps between
  std::vector<Transition> ways;
  double path = 0, sum = 0;
  for (size_t i = 0; i + 1 < segments.size(); ++i) {
    const Index first = middle(segments[i]), last = middle(segments[i + 1]);
    if (!is_same_speed(segments[i]) || !is_same_speed(segments[i + 1])) continue;
    if (IsBroken(taken, first, last, longest)) continue;
    const double from = taken.time[first], to = taken.time[last];
    const double length = position.Between(from, to);
    ways.push_back({first, last, length, velocity.Between(from, to) - length});
    sum += ways.back().difference;
    path += length;
  }
  const auto n = static_cast<double>(ways.size());
  if (n < kFewest || path == 0) return std::nullopt;

  // standard error of the mean difference, from its spread over the ways
  double squares = 0;
  for (const Transition& way : ways) squares += std::pow(way.difference - sum / n, 2);
  return PathComparison{sum / path, std::sqrt(squares / (n - 1) * n) / path, std::move(ways)};
}

bool Contradicts(const PathComparison& paths) {
  return std::abs(paths.excess) > std::max(kHarmless, kCertain * paths.error);
}

bool PositionsTellMore(const PathComparison& paths, double deviation) {
  double squares = 0, length = 0;
  for (const Transition& way : paths.ways) {
    squares += way.difference * way.difference;
    length += way.length;
  }
  const auto n = static_cast<double>(paths.ways.size());
  const double least = std::max(8 * deviation * deviation, std::pow(kNoMatter * length / n, 2));
  return squares / n > least;
}

}  // namespace warmjoint
