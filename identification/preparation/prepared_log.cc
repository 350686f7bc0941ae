#include "identification/preparation/prepared_log.h"

#include <algorithm>

#include "identification/preparation/log_faults.h"
#include "identification/preparation/select.h"
#include "identification/preparation/split_at_switches.h"

namespace warmjoint::inline identification {
namespace {

LogView Head(const LogView& all, double time) {
  const Eigen::Index n = (all.measurements.time.array() < time).count();
  LogView head{FirstSamples(all.measurements, n), {all.selection.keep.head(n), {}}};
  for (Segment segment : all.selection.segments) {
    if (segment.begin >= n) break;
    segment.end = std::min(segment.end, n);
    head.selection.segments.push_back(segment);
  }
  return head;
}

}  // namespace

PreparedLog PreparedLog::Before(double time) const {
  Log before{Head(log_->taken, time), std::nullopt, log_->velocity_noise, log_->unseen,
             log_->faults};
  if (log_->steady) before.steady = Head(*log_->steady, time);
  return PreparedLog(std::move(before));
}

PreparedLog Prepare(Measurements measurements) {
  Selection selection = SelectConstantSpeed(measurements);
  return Prepare(std::move(measurements), std::move(selection));
}

PreparedLog Prepare(Measurements measurements, Selection known) {
  PreparedLog::Log log{{std::move(measurements), std::move(known)}, {}, {}, 0, {}};
  const auto& [taken, selection] = log.taken;
  log.faults = FindFaults(taken, selection);

  // one velocity for each segment
  std::optional<SegmentVelocity> level = TakeSegmentVelocity(taken, selection);
  if (level) log.velocity_noise = level->noise;

  // a sample at each switch of speed
  std::optional<SplitLog> split = SplitAtSwitches(level ? level->measurements : taken, selection);
  if (split) {
    log.unseen = split->unseen;
    log.steady = {std::move(split->measurements), std::move(split->selection)};
  } else if (level) {
    log.steady = {std::move(level->measurements), selection};
  }
  return PreparedLog(std::move(log));
}

}  // namespace warmjoint::inline identification
