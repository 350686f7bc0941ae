#include "identification/preparation/replace_transitions.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "identification/preparation/insert_samples.h"
#include "models/recording/sampling.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kBehind = 1e-6;  // of a step

/// What one version of a log says of the motion.
struct Telling {
  VectorXd velocity;                     // [N] of the samples that were taken
  std::vector<InsertedSample> inserted;  // ascending in time
};

Telling TellingOf(const Measurements& version, const VectorXd& time) {
  Telling telling{VectorXd(time.size()), {}};
  Index n = 0;
  // samples of the log take their velocity from the version, the others were put in by it
  for (Index i = 0; i < version.size(); ++i) {
    if (n < time.size() && version.time[i] == time[n]) {
      telling.velocity[n++] = version.velocity[i];
    } else {
      telling.inserted.push_back(
          {n - 1, version.time[i], version.position[i], version.velocity[i]});
    }
  }
  return telling;
}

/// Which samples lie on a way whose two tellings differ by no more than sampling explains. [N]
Eigen::Array<bool, Eigen::Dynamic, 1> OnWays(const std::vector<Transition>& ways,
                                             const Telling& velocity, const VectorXd& time) {
  Eigen::Array<bool, Eigen::Dynamic, 1> on(time.size());
  on.setConstant(false);
  const double step = MedianStep(time);
  for (const Transition& way : ways) {
    // sampling misplaces a change of speed by a step at most
    const double change = std::abs(velocity.velocity[way.last] - velocity.velocity[way.first]);
    if (std::abs(way.difference) > step * change) continue;
    on.segment(way.first, way.last - way.first).setConstant(true);
  }
  return on;
}

}  // namespace

LogView ReplaceTransitions(const LogView& taken, const Measurements& by_velocity,
                           const Measurements& by_position, const std::vector<Transition>& ways) {
  const auto& [m, selection] = taken;
  const Telling velocity = TellingOf(by_velocity, m.time),
                position = TellingOf(by_position, m.time);
  const auto on = OnWays(ways, velocity, m.time);

  // what each version puts in where it is believed, but nothing within a segment
  std::set<Index> begins;
  for (const Segment& segment : selection.segments) begins.insert(segment.begin);
  const auto is_within = [&](Index n) {
    return selection.keep[n] && selection.keep[n + 1] && !begins.contains(n + 1);
  };
  std::vector<InsertedSample> inserted;
  const auto add = [&](const Telling& telling, bool here) {
    for (const InsertedSample& one : telling.inserted) {
      if (on[one.after] == here && !is_within(one.after)) inserted.push_back(one);
    }
  };
  add(velocity, false);
  add(position, true);

  // the speeds of the samples; right behind the last of a segment the speed changes
  LogView log = taken;
  for (Index n = 0; n < m.size(); ++n) {
    const bool changes = on[n] && !selection.keep[n];
    log.measurements.velocity[n] = (changes ? position : velocity).velocity[n];
    // where the positions tell, a segment is left right behind its last sample
    if (!on[n] || changes || n + 1 == m.size() || selection.keep[n + 1]) continue;
    const double behind = m.time[n] + kBehind * (m.time[n + 1] - m.time[n]);
    inserted.push_back({n, behind, m.position[n], position.velocity[n]});
  }
  std::ranges::sort(inserted, {}, &InsertedSample::time);
  InsertSamples(inserted, log.measurements, log.selection);
  return log;
}

}  // namespace warmjoint
