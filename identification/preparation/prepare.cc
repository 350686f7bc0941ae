#include <fmt/format.h>
#include <warmjoint/prepared_log.h>

#include <cmath>
#include <utility>

#include "identification/preparation/log_faults.h"
#include "identification/preparation/motion_from_positions.h"
#include "identification/preparation/moving_view.h"
#include "identification/preparation/position_noise.h"
#include "identification/preparation/segment_velocity.h"
#include "identification/preparation/select.h"
#include "identification/preparation/transitions.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

constexpr double kLargest = 1e30;  // of a velocity; beyond it squares and products overflow

/// The samples of constant speed by the positions alone. The velocity of the log becomes their smoothed slope.
ConstantSpeed FindFromPositions(Measurements& m) {
  // in steps of the encoder, so that the choice does not depend on where its zero is
  const auto [steps, step, resolution] = FromFirst(m.position);
  m.velocity = DeriveVelocity(m.time, steps, ChooseCutoff(m.time, steps));
  ConstantSpeed found = FindConstantSpeed(m);
  m.velocity *= step;
  for (auto* segments : {&found.selection.segments, &found.rests}) {
    for (Segment& segment : *segments) segment.velocity *= step;
  }
  // squares and products of absurd velocities would overflow
  const double fastest = m.velocity.cwiseAbs().maxCoeff();
  if (!(fastest <= kLargest)) {
    Refuse({m.source},
           "the positions change by {} {} at most; no velocity can be computed from them", fastest,
           kVelocityUnit.For(m.joint));
  }
  return found;
}

/// Whether the speeds of a log that was made from positions agree with its velocity column, over all samples at which both find
/// a constant speed. They do not where time stamps jitter, which disturbs the former. keep: [N] samples of `column`.
bool AgreesOnSpeeds(const LogView& log, const Measurements& column, const SampleMask& keep) {
  double by_column = 0, by_position = 0;
  for (Eigen::Index i = 0; const Eigen::Index n : log.measurements.Logged()) {
    if (keep[i] && log.selection.keep[n]) {
      by_column += std::abs(column.velocity[i]);
      by_position += std::abs(log.measurements.velocity[n]);
    }
    ++i;
  }
  return std::abs(by_column - by_position) <= kSameSpeed * by_position;
}

/// Leaves out samples at which a velocity column that is not used does not show a constant speed. The column may not have
/// settled there, and then a torque that went through the same filter has not either. keep: [N] of the
/// samples that were logged.
void KeepAlso(const SampleMask& keep, LogView& log) {
  const std::vector<Eigen::Index> logged = log.measurements.Logged();
  log.selection.keep(logged) = log.selection.keep(logged) && keep;
}

/// The sentence that a velocity column is not used. step: of the column, rad/s or m/s
std::string SayCoarse(double step, JointKind joint) {
  return fmt::format(
      "the velocity column comes in steps of {:.3g} {}, and the positions show the speeds more "
      "finely: the velocity is taken from the positions, and the column is not used",
      step, kVelocityUnit.For(joint));
}

/// The beginning of a sentence: column and positions contradict each other.
std::string SayContradiction(const PathComparison& paths) {
  return fmt::format(
      "integrated over the changes of speed, the velocity column gives a path that is {:.2g} % "
      "{} than that of the positions ({} changes)",
      100 * std::abs(paths.excess), paths.excess < 0 ? "shorter" : "longer",
      paths.transitions.size());
}

}  // namespace

/// Makes the logs that Prepare returns, each of one recording.
struct PreparedLog::Maker {
  /// By the velocity column: one velocity for each segment, where noise would attenuate the slopes, and a sample
  /// at each switch of speed. selection: the samples of constant speed, before `holds` leaves some of them out.
  static Log ByColumn(Measurements measurements, Selection selection,
                      const PrepareSettings& holds) {
    Log log{.raw = {LogSamples(std::move(measurements)), std::move(selection)}};
    auto level = TakeSegmentVelocity(log.raw.measurements, log.raw.selection);
    log.holds_speeds = HoldsSpeeds(log.raw.measurements, log.raw.selection);
    TakeOptions(holds, log.raw.measurements.time, log.raw.selection);
    if (level) {
      log.velocity_noise = level->noise;
      log.constant_speed = log.raw;
      log.constant_speed->measurements.velocity = std::move(level->velocity);
    }
    if (auto split = SplitAtSwitches(log.constant_speed ? *log.constant_speed : log.raw)) {
      log.unresolved_path = split->unresolved_path;
      log.constant_speed = std::move(split->view);
    }
    log.faults = FindFaults(log.raw.measurements, log.raw.selection);
    return log;
  }

  /// By the positions: their smoothed slopes show where the joint moves, and the positions themselves how. A velocity column is
  /// not looked at.
  static Log ByPositions(Measurements measurements, const PrepareSettings& holds) {
    measurements.notes.emplace_back(
        "velocity computed from the positions, one value for each segment");
    Log log{.raw = {LogSamples(std::move(measurements)), {}}, .source = MotionSource::positions};
    auto& [measured, selection] = log.raw;
    ConstantSpeed found = FindFromPositions(measured);
    FilledLog motion = MotionFromPositions(measured, found);
    selection = std::move(found.selection);
    log.constant_speed = std::move(motion.view);
    log.unresolved_path = motion.unresolved_path;
    log.holds_speeds = HoldsSpeeds(measured, selection, MotionSource::positions);
    TakeOptions(holds, log.constant_speed->measurements.time, log.constant_speed->selection);
    TakeOptions(holds, measured.time, selection);
    log.faults = FindFaults(measured, selection, MotionSource::positions);
    return log;
  }

  /// By the velocity column, compared with the positions. These replace the column where it is so coarse that the positions
  /// show its steps, or where it contradicts them over its changes of speed. They replace only the changes of speed where they
  /// determine these better.
  static Log ByBoth(const Measurements& measurements, const PrepareSettings& holds) {
    const ConstantSpeed found = FindConstantSpeed(measurements);
    if (measurements.position_integrated) return ByColumn(measurements, found.selection, holds);
    // a column in steps so coarse that the positions show it
    std::optional<Log> by_positions;
    if (const auto step = CoarseStep(measurements, found.selection)) {
      by_positions = ByPositions(measurements, holds);
      if (by_positions->faults.empty()) {
        by_positions->warnings.push_back(SayCoarse(*step, measurements.joint));
        return *std::move(by_positions);
      }
    }
    Log log = ByColumn(measurements, found.selection, holds);
    if (!log.faults.empty()) return log;

    // the paths from one segment to the next, by both
    const FilledLog motion = MotionFromPositions(measurements, found);
    const LogSamples& by_column = (log.constant_speed ? *log.constant_speed : log.raw).measurements;
    const LogSamples& by_position = motion.view.measurements;
    const auto paths = ComparePaths(by_column, by_position, found.selection.segments, measurements);
    if (!paths) return log;
    if (Contradicts(*paths)) {
      if (!by_positions) by_positions = ByPositions(measurements, holds);
      return InsteadOf(std::move(log), *std::move(by_positions), *paths, found.selection.keep);
    }
    // speeds of the column, and between them the paths of the positions
    if (PositionsTellMore(*paths, motion.position_deviation)) {
      log.constant_speed = ReplaceTransitions(log.raw, by_column, by_position, paths->transitions);
      log.unresolved_path = motion.unresolved_path;
    }
    return log;
  }

  /// Chooses between a log by its column and the same log by the positions, where these contradict the column over its changes
  /// of speed. It is the former where the positions have other speeds than the column between these changes. keep: [N] of the column.
  static Log InsteadOf(Log column, Log positions, const PathComparison& paths,
                       const SampleMask& keep) {
    const std::string contradiction = SayContradiction(paths);
    if (!AgreesOnSpeeds(*positions.constant_speed, column.raw.measurements, keep)) {
      column.warnings.push_back(contradiction +
                                ", but the constant speeds of the two differ, too: the clock "
                                "jitters, or the positions are "
                                "spoilt, so the velocity column is kept");
      return column;
    }
    KeepAlso(keep, positions.raw);
    KeepAlso(keep, *positions.constant_speed);
    positions.warnings.push_back(contradiction +
                                 ": it is filtered, late, scaled or sampled too seldom, so the "
                                 "velocity is computed from the positions");
    return positions;
  }
};

PreparedLog Prepare(Measurements measurements, const PrepareSettings& holds) {
  const bool has_velocity = measurements.velocity.size() > 0;
  return PreparedLog(has_velocity
                         ? PreparedLog::Maker::ByBoth(measurements, holds)
                         : PreparedLog::Maker::ByPositions(std::move(measurements), holds));
}

PreparedLog Prepare(std::vector<Measurements> recordings, const PrepareSettings& holds) {
  std::vector<PreparedLog> prepared;
  for (Measurements& one : recordings) prepared.push_back(Prepare(std::move(one), holds));
  return Join(std::move(prepared));
}

PreparedLog Prepare(Measurements measurements, Selection known) {
  return PreparedLog(PreparedLog::Maker::ByColumn(std::move(measurements), std::move(known), {}));
}

}  // namespace warmjoint
