#include "tools/figures/speed_groups.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "models/foundation/robust_noise.h"
#include "tools/figures/symbols.h"

namespace warmjoint::figures {
namespace {

constexpr double kAlike = 0.05;    // relative difference of speeds that count as one
constexpr double kStray = 0.02;    // share of the samples below which a speed joins its neighbour
constexpr double kLabelled = 0.9;  // share of the samples that a label speaks of
constexpr std::size_t kBins = 3;   // where there are too many speeds for a colour each
constexpr Hue kHues[] = {Hue::blue, Hue::green, Hue::orange, Hue::vermilion, Hue::purple, Hue::sky};

/// Samples of one speed: the mean of a segment, once for each kept sample, ascending.
using Speeds = std::vector<double>;

Speeds SpeedsOfSamples(const FitView& view) {
  Speeds speeds;
  for (const Segment& segment : view.selection.segments) {
    const auto kept = view.selection.keep.segment(segment.begin, segment.end - segment.begin);
    speeds.insert(speeds.end(), static_cast<std::size_t>(kept.count()), std::abs(segment.velocity));
  }
  std::sort(speeds.begin(), speeds.end());
  return speeds;
}

double Distance(const Speeds& slower, const Speeds& faster) {
  return std::log(faster.front() / slower.back());
}

/// Adds what strays into the nearer neighbour.
void JoinStrays(std::size_t all, std::vector<Speeds>& clusters) {
  for (std::size_t i = 0; i < clusters.size() && clusters.size() > 1;) {
    // a group with enough samples stays
    if (static_cast<double>(clusters[i].size()) >= kStray * static_cast<double>(all)) {
      ++i;
      continue;
    }
    // a stray joins the neighbour that is nearer, by the ratio of speeds
    const bool upwards =
        i == 0 || (i + 1 < clusters.size() &&
                   Distance(clusters[i], clusters[i + 1]) < Distance(clusters[i - 1], clusters[i]));
    const std::size_t slower = upwards ? i : i - 1;
    clusters[slower].insert(clusters[slower].end(), clusters[slower + 1].begin(),
                            clusters[slower + 1].end());
    clusters.erase(clusters.begin() + static_cast<std::ptrdiff_t>(slower) + 1);
    i = slower;
  }
}

/// One cluster for each speed; where colours do not suffice, bins of about equal numbers of samples
/// that never part a speed.
std::vector<Speeds> ClustersOf(const Speeds& speeds) {
  std::vector<Speeds> single;
  // speeds that differ by little are one
  for (double speed : speeds) {
    if (single.empty() || speed > (1 + kAlike) * single.back().front()) single.emplace_back();
    single.back().push_back(speed);
  }
  std::vector<Speeds> clusters = single;
  JoinStrays(speeds.size(), clusters);
  // few speeds have a colour each
  if (clusters.size() <= std::size(kHues)) return clusters;

  // more of them share bins of about as many samples each
  clusters.clear();
  std::size_t before = 0;  // samples in the bins so far
  for (const Speeds& speed : single) {
    const std::size_t bin = before * kBins / speeds.size();
    if (clusters.size() <= bin) clusters.emplace_back();
    clusters.back().insert(clusters.back().end(), speed.begin(), speed.end());
    before += speed.size();
  }
  return clusters;
}

/// Three digits, without zeros at the end: 0.125, 0.3.
std::string SpeedText(double speed) {
  std::string text = SignificantText(speed, 3);
  if (text.find('.') == text.npos || text.find("·") != text.npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

/// "0.3 rad/s" where nearly all samples are about so fast, else "0.3 … 0.6 rad/s".
std::string LabelOf(const Speeds& speeds, const std::string& unit) {
  const double slow = Quantile(speeds, (1 - kLabelled) / 2);
  const double fast = Quantile(speeds, (1 + kLabelled) / 2);
  if (fast <= (1 + 2 * kAlike) * slow) {
    return fmt::format("{} {}", SpeedText(Quantile(speeds, 0.5)), unit);
  }
  return fmt::format("{} … {} {}", SpeedText(speeds.front()), SpeedText(speeds.back()), unit);
}

}  // namespace

std::vector<SpeedGroup> GroupBySpeed(const FitView& view, int direction) {
  const std::string unit = UnitText(kVelocityUnit.For(view.joint));
  std::vector<SpeedGroup> groups;
  // groups have the same colours in both directions
  for (const Speeds& speeds : ClustersOf(SpeedsOfSamples(view))) {
    groups.push_back({speeds.back(), kHues[groups.size()], LabelOf(speeds, unit), {}});
  }
  // samples of this direction, in the group of their speed
  for (const Segment& segment : view.selection.segments) {
    if (segment.velocity * direction <= 0) continue;
    const double speed = std::abs(segment.velocity);
    const auto fits = [&](const SpeedGroup& group) { return speed <= group.fastest; };
    const auto group = std::find_if(groups.begin(), groups.end(), fits);
    if (group == groups.end()) continue;
    for (Eigen::Index i = segment.begin; i < segment.end; ++i) {
      if (view.selection.keep[i]) group->samples.push_back(i);
    }
  }
  return groups;
}

}  // namespace warmjoint::figures
