#include "identification/preparation/split_at_switches.h"

#include <algorithm>
#include <cmath>

#include "identification/preparation/insert_samples.h"
#include "models/foundation/robust_noise.h"
#include "models/recording/sampling.h"

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr double kLeastChange = 0.1;  // of the velocity's rms
constexpr double kSteady =
    0.25;  // of the change, before and behind; why: with 0.17 or 0.38 64 logs are covered as well
constexpr double kInside = 1e-6;  // of an interval: a switch nearer to a sample is at it

/// A sample to put in after sample `after`.
struct Switch {
  Index after = 0;
  double delay = 0;  // s behind it
};

/// Whether the change of speed behind sample n stands alone: no ramp that the samples show.
bool StandsAlone(const Eigen::VectorXd& v, Index n) {
  const double before = n > 0 ? std::abs(v[n] - v[n - 1]) : 0;
  const double behind = n + 2 < v.size() ? std::abs(v[n + 2] - v[n + 1]) : 0;
  return std::max(before, behind) <= kSteady * std::abs(v[n + 1] - v[n]);
}

std::vector<Switch> FindSwitches(const Measurements& m) {
  const double rms = std::sqrt(m.velocity.squaredNorm() / static_cast<double>(m.size()));
  const double longest = LongestStep(m.time);
  std::vector<Switch> switches;
  for (Index n = 0; n + 1 < m.size(); ++n) {
    const double v0 = m.velocity[n], v1 = m.velocity[n + 1];
    const double h = m.time[n + 1] - m.time[n];
    if (std::abs(v1 - v0) <= kLeastChange * rms || h > longest) continue;
    // one step changes the speed, those around it do not
    if (!StandsAlone(m.velocity, n)) continue;
    // v0 until the switch and v1 behind it must make the way between the samples
    const double s = (m.position[n + 1] - m.position[n] - v1 * h) / (v0 - v1);
    const bool is_inside = s > kInside * h && s < (1 - kInside) * h;
    if (is_inside && !std::ranges::binary_search(m.starts, n + 1)) switches.push_back({n, s});
  }
  return switches;
}

/// SplitLog::unseen.
double Unseen(const Measurements& m, const std::vector<Switch>& switches) {
  double lost = 0, path = 0;
  // path by the velocities
  for (Index n = 0; n + 1 < m.size(); ++n) {
    path += std::abs(m.velocity[n]) * (m.time[n + 1] - m.time[n]);
  }
  for (const auto& [after, delay] : switches) {
    // a reversal within a step: the longest ramp that no sample would show
    const double v0 = m.velocity[after], v1 = m.velocity[after + 1];
    if (v0 * v1 >= 0) continue;
    const double h = m.time[after + 1] - m.time[after];
    lost += 2 * std::min(delay, h - delay) * std::abs(v0 * v1 / (v0 - v1));
  }
  return path > 0 ? lost / path : 0;
}

}  // namespace

std::optional<SplitLog> SplitAtSwitches(const Measurements& measurements,
                                        const Selection& selection) {
  const std::vector<Switch> switches = FindSwitches(measurements);
  if (switches.empty()) return std::nullopt;
  SplitLog split{measurements, selection, Unseen(measurements, switches)};
  // a sample at each switch, from which on the later velocity holds
  std::vector<InsertedSample> inserted;
  for (const auto& [after, delay] : switches) {
    inserted.push_back({after, measurements.time[after] + delay,
                        measurements.position[after] + delay * measurements.velocity[after],
                        measurements.velocity[after + 1]});
  }
  InsertSamples(inserted, split.measurements, split.selection);
  return split;
}

}  // namespace warmjoint
