#include <fmt/format.h>
#include <warmjoint/prepared_log.h>

#include <cmath>

#include "identification/preparation/derive_velocity.h"
#include "identification/preparation/log_faults.h"
#include "identification/preparation/motion_from_positions.h"
#include "identification/preparation/path_against_velocity.h"
#include "identification/preparation/position_noise.h"
#include "identification/preparation/replace_transitions.h"
#include "identification/preparation/segment_velocity.h"
#include "identification/preparation/select.h"
#include "identification/preparation/split_at_switches.h"
#include "models/foundation/bad_input.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

constexpr double kLargest = 1e30;  // of a velocity; beyond it squares and products overflow

/// What moves at constant speed in a log without a velocity, which is filled with the smoothed slope
/// of its positions.
ConstantSpeed FindFromPositions(Measurements& m) {
  ConstantSpeed found;
  found.selection.keep.setConstant(m.size(), false);
  m.velocity.resize(m.size());
  for (const auto& [first, count] : RecordingsOf(m)) {
    // in steps of the encoder, so that the choice does not depend on where its zero is
    const auto [steps, step] = FromFirst(m.position.segment(first, count));
    Measurements one;
    one.time = m.time.segment(first, count);
    one.velocity = DeriveVelocity(one.time, steps, ChooseCutoff(one.time, steps));
    Append(FindConstantSpeed(one), first, step, found);
    m.velocity.segment(first, count) = step * one.velocity;
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

/// What is done to the velocity of a log that has one: one for each segment, and a sample at each
/// switch of speed.
struct Refined {
  std::optional<LogView> steady;
  std::optional<VelocityNoise> noise;
  double unseen = 0;
};

Refined Refine(const LogView& taken) {
  const auto& [measurements, selection] = taken;
  Refined refined;
  // one velocity for each segment, where noise would take something off the slopes
  std::optional<SegmentVelocity> level = TakeSegmentVelocity(measurements, selection);
  if (level) refined.noise = level->noise;
  // samples put in where the speed changes between two
  std::optional<SplitLog> split =
      SplitAtSwitches(level ? level->measurements : measurements, selection);
  if (split) {
    refined.unseen = split->unseen;
    refined.steady = {std::move(split->measurements), std::move(split->selection)};
  } else if (level) {
    refined.steady = {std::move(level->measurements), selection};
  }
  return refined;
}

/// A log with a velocity column as its positions tell it, and how far the two tell the same path.
struct OtherTelling {
  PositionMotion motion;
  std::optional<PathComparison> paths;
};

OtherTelling TellByPositions(const Measurements& m, const ConstantSpeed& found) {
  const Refined refined = Refine({m, found.selection});
  OtherTelling other{MotionFromPositions(m, found.selection, found.rests), {}};
  other.paths = ComparePaths(refined.steady ? refined.steady->measurements : m,
                             other.motion.measurements, found.selection.segments, m);
  return other;
}

/// In what the positions contradict the velocity column, a clause. Nothing where they agree, or
/// where the log has faults, by which the positions may be wrong as well.
std::optional<std::string> PathContradiction(const Measurements& m, const Selection& selection,
                                             const std::optional<PathComparison>& paths) {
  if (!paths || !Contradicts(*paths) || !FindFaults(m, selection).empty()) return std::nullopt;
  return fmt::format(
      "integrated over the changes of speed, the velocity column gives a path that is {:.2g} % {} "
      "than that of the positions ({} changes)",
      100 * std::abs(paths->excess), paths->excess < 0 ? "shorter" : "longer", paths->ways.size());
}

/// Calls visit(i, n) for each sample i at `time` that the log has, too, as its sample n.
template <typename Visit>
void ForEachCommon(const Eigen::VectorXd& time, const LogView& log, const Visit& visit) {
  Eigen::Index i = 0;
  for (Eigen::Index n = 0; n < log.measurements.size() && i < time.size(); ++n) {
    if (log.measurements.time[n] == time[i]) visit(i++, n);
  }
}

/// Whether the speeds of a log made from positions are those of a velocity column where both call them
/// constant, over all of them: stamps that jitter spoil the former. velocity, keep: [N] samples at `time`.
bool AgreesOnSpeeds(const LogView& log, const Eigen::VectorXd& velocity,
                    const Eigen::Array<bool, Eigen::Dynamic, 1>& keep,
                    const Eigen::VectorXd& time) {
  double told = 0, way = 0;
  ForEachCommon(time, log, [&](Eigen::Index i, Eigen::Index n) {
    if (!keep[i] || !log.selection.keep[n]) return;
    told += std::abs(velocity[i]);
    way += std::abs(log.measurements.velocity[n]);
  });
  return std::abs(told - way) <= kSameSpeed * way;
}

/// Leaves out what a velocity column that is not believed did not call constant: it may not have
/// settled there, and a torque that went through the same filter has not either. keep: [N] samples
/// at `time`; log: of these and others.
void KeepAlso(const Eigen::Array<bool, Eigen::Dynamic, 1>& keep, const Eigen::VectorXd& time,
              LogView& log) {
  ForEachCommon(time, log, [&](Eigen::Index i, Eigen::Index n) {
    if (!keep[i]) log.selection.keep[n] = false;
  });
}

}  // namespace

/// Makes the logs that Prepare promises.
struct PreparedLog::Maker {
  /// A log whose velocity column tells when the speed is constant.
  static Log OfColumn(Measurements measurements, Selection known) {
    Log log{{std::move(measurements), std::move(known)}, MotionSource::velocity, {}, {}, 0, {}, {}};
    log.faults = FindFaults(log.taken.measurements, log.taken.selection);
    Refined refined = Refine(log.taken);
    log.steady = std::move(refined.steady);
    log.velocity_noise = refined.noise;
    log.unseen = refined.unseen;
    return log;
  }

  /// A log whose positions tell the velocity.
  static Log OfPositions(Measurements measurements, const PrepareSettings& holds) {
    measurements.notes.emplace_back(
        "velocity computed from the positions, one value for each segment");
    Log log{{std::move(measurements), {}}, MotionSource::positions, {}, {}, 0, {}, {}};
    Measurements& taken = log.taken.measurements;
    // selection by the smoothed slopes, steady motion by the positions themselves
    ConstantSpeed found = FindFromPositions(taken);
    PositionMotion motion = MotionFromPositions(taken, found.selection, found.rests);
    TakeOptions(holds, motion.measurements.time, motion.selection);
    TakeOptions(holds, taken.time, found.selection);
    log.taken.selection = std::move(found.selection);
    log.steady = {std::move(motion.measurements), std::move(motion.selection)};
    log.unseen = motion.unseen;
    log.faults = FindFaults(taken, log.taken.selection, MotionSource::positions);
    return log;
  }

  /// A log whose positions contradict its velocity column, from the positions. Nothing where these by themselves tell
  /// other speeds.
  static std::optional<Log> WithoutColumn(const Measurements& measurements,
                                          const Selection& selection,
                                          const PrepareSettings& holds) {
    Measurements positions = measurements;
    positions.velocity.resize(0);
    Log log = OfPositions(std::move(positions), holds);
    const Eigen::VectorXd& time = measurements.time;
    // the positions must tell the same speeds as the column that is left out
    if (!AgreesOnSpeeds(*log.steady, measurements.velocity, selection.keep, time)) return {};
    KeepAlso(selection.keep, time, log.taken);
    KeepAlso(selection.keep, time, *log.steady);
    return log;
  }

  /// A log whose velocity column comes in steps so coarse that the positions show it, from the positions. Nothing where
  /// these have faults.
  static std::optional<Log> WithoutCoarseColumn(const Measurements& measurements,
                                                const Selection& selection,
                                                const PrepareSettings& holds) {
    const std::optional<double> step = CoarseStep(measurements, selection);
    if (!step) return {};
    Measurements positions = measurements;
    positions.velocity.resize(0);
    Log log = OfPositions(std::move(positions), holds);
    if (!log.faults.empty()) return {};
    log.warnings.push_back(fmt::format(
        "the velocity column comes in steps of {:.3g} {}, and the positions tell the speeds more "
        "finely: the velocity is taken from the positions, and the column is not used",
        *step, kVelocityUnit.For(measurements.joint)));
    return log;
  }

  /// A log whose velocity column is held against its positions, if it has any: these replace it where they contradict it,
  /// and tell the ways between its segments where they know more of these.
  static Log OfColumnAndPositions(Measurements measurements, const PrepareSettings& holds) {
    ConstantSpeed found = FindConstantSpeed(measurements);
    if (measurements.position_integrated) {
      TakeOptions(holds, measurements.time, found.selection);
      return OfColumn(std::move(measurements), std::move(found.selection));
    }
    if (auto log = WithoutCoarseColumn(measurements, found.selection, holds)) {
      return std::move(*log);
    }
    const OtherTelling other = TellByPositions(measurements, found);
    const auto contradiction = PathContradiction(measurements, found.selection, other.paths);
    if (contradiction) {
      if (auto log = WithoutColumn(measurements, found.selection, holds)) {
        log->warnings.push_back(*contradiction +
                                ": it is filtered, late, scaled or sampled too seldom, and the "
                                "positions are used instead");
        return std::move(*log);
      }
    }

    TakeOptions(holds, measurements.time, found.selection);
    Log log = OfColumn(std::move(measurements), std::move(found.selection));
    if (contradiction) {
      log.warnings.push_back(
          *contradiction +
          ", but by themselves these tell other speeds: the clock jitters, or the positions are "
          "spoilt, and the column is used");
    } else if (other.paths && log.faults.empty()) {
      TakeWaysOf(other, log);
    }
    return log;
  }

  static void TakeWaysOf(const OtherTelling& other, Log& log) {
    const LogView& steady = log.steady ? *log.steady : log.taken;
    const double noise = MeasurePositionNoise(log.taken.measurements.position).deviation;
    if (!PositionsTellMore(*other.paths, noise)) return;
    log.steady = ReplaceTransitions(log.taken, steady.measurements, other.motion.measurements,
                                    other.paths->ways);
    log.unseen = other.motion.unseen;
  }
};

PreparedLog Prepare(Measurements measurements, const PrepareSettings& holds) {
  const bool has_velocity = measurements.velocity.size() > 0;
  const auto make =
      has_velocity ? &PreparedLog::Maker::OfColumnAndPositions : &PreparedLog::Maker::OfPositions;
  return PreparedLog(make(std::move(measurements), holds));
}

PreparedLog Prepare(Measurements measurements, Selection known) {
  return PreparedLog(PreparedLog::Maker::OfColumn(std::move(measurements), std::move(known)));
}

}  // namespace warmjoint
