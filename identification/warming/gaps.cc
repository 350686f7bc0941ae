#include "identification/warming/gaps.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "identification/fit_parameters.h"
#include "models/friction/thermal.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

constexpr size_t kMostGaps = 50;

bool RestsOver(const LogSamples& m, Eigen::Index behind) {
  return m.velocity[behind - 1] == 0 && m.velocity[behind] == 0 &&
         m.position[behind - 1] == m.position[behind];
}

bool IsLonger(const LogGap& a, const LogGap& b) { return a.length > b.length; }

}  // namespace

std::vector<LogGap> FindGaps(const LogSamples& measurements) {
  const LogSamples& m = measurements;
  std::vector<LogGap> gaps = m.gaps ? *m.gaps : GapsOf(m.time);
  // a joint at rest loses nothing, and a new recording is no gap
  std::erase_if(gaps, [&](const LogGap& gap) {
    return RestsOver(m, gap.behind) || std::ranges::binary_search(m.further_starts, gap.behind);
  });
  if (gaps.size() <= kMostGaps) return gaps;
  // the longest of them, in order of time
  std::nth_element(gaps.begin(), gaps.begin() + kMostGaps, gaps.end(), IsLonger);
  gaps.resize(kMostGaps);
  std::ranges::sort(gaps, {}, &LogGap::behind);
  return gaps;
}

std::vector<LogGap> FurtherStarts(const LogSamples& measurements) {
  std::vector<LogGap> starts;
  for (const Eigen::Index start : measurements.further_starts) {
    starts.push_back({start, std::numeric_limits<double>::infinity()});
  }
  return starts;
}

std::vector<LogGap> FreeStarts(const InitialEnergy& initial, const LogSamples& measurements,
                               const Selection& kept) {
  if (!initial.is_open()) return {};
  std::vector<LogGap> free = FurtherStarts(measurements);
  for (const SampleRange& one : measurements.Recordings()) {
    if (kept.keep.segment(one.first, one.count).any()) continue;
    std::erase_if(free, [&](const LogGap& start) { return start.behind == one.first; });
  }
  return free;
}

std::vector<LogGap> Merged(const std::vector<LogGap>& one, const std::vector<LogGap>& other) {
  std::vector<LogGap> both;
  std::ranges::merge(one, other, std::back_inserter(both), {}, &LogGap::behind, &LogGap::behind);
  return both;
}

Eigen::VectorXd JumpSpread(const std::vector<LogGap>& gaps, double warmest, double time_constant) {
  Eigen::VectorXd spread(static_cast<Eigen::Index>(gaps.size()));
  for (size_t i = 0; i < gaps.size(); ++i) {
    spread[static_cast<Eigen::Index>(i)] =
        IsStart(gaps[i]) ? std::numeric_limits<double>::infinity()
                         : warmest * HoldOver(gaps[i].length, time_constant).cooling;
  }
  return spread;
}

std::vector<std::string> JumpNames(const std::vector<LogGap>& gaps,
                                   const LogSamples& measurements) {
  std::vector<std::string> names;
  int gap = 0;
  for (const LogGap& at : gaps) {
    const auto recording = std::ranges::upper_bound(measurements.further_starts, at.behind) -
                           measurements.further_starts.begin();
    names.push_back(IsStart(at) ? NameOf(Role::start, static_cast<int>(recording))
                                : NameOf(Role::jump, gap++));
  }
  return names;
}

std::vector<Eigen::Index> Behind(const std::vector<LogGap>& gaps) {
  std::vector<Eigen::Index> behind;
  for (const LogGap& gap : gaps) behind.push_back(gap.behind);
  return behind;
}

}  // namespace warmjoint
