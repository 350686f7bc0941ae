// What code does to the columns of a recording: as a whole, and in time.
#pragma once

#include <warmjoint/recording.h>

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "models/foundation/robust_noise.h"

namespace warmjoint {

/// Calls use(column) for every column that the log has: the one list of them, for what is done to
/// all alike. log: Measurements, or what preparation makes of them.
template <typename Log, typename Use>
void ForEachColumn(Log& log, Use&& use) {
  for (auto* column : {&log.time, &log.position, &log.velocity, &log.torque}) use(*column);
  const auto use_optional = [&](auto*... columns) { ((*columns ? use(**columns) : void()), ...); };
  use_optional(&log.motor_position, &log.load, &log.temperature);
  if constexpr (requires { log.loss_velocity; }) {
    use_optional(&log.acceleration, &log.mean_speed, &log.loss_velocity);
  }
}

/// Whether the motor's angle is told apart from the joint's: logged, or turned by a gear. A gear of
/// -1 turns the motor against the joint by the same angle, which tells nothing new.
inline bool KnowsMotorAngle(const Measurements& measurements) {
  return measurements.motor_position ||
         (std::abs(measurements.gear) != 1 && !measurements.position_integrated);
}

/// What cannot be told by a log without positions, one sentence.
inline constexpr const char* kNoPositions =
    "the log has no positions: they are integrated from the velocity, and gravity and what repeats "
    "over the position "
    "cannot be told";

/// The logged motor position, else gear times the joint's. [N] rad
inline Eigen::VectorXd MotorPosition(const Measurements& measurements) {
  return measurements.motor_position.value_or(measurements.gear * measurements.position);
}

/// The same selection without samples of velocity 0. Friction at v = 0 is whatever holds the joint,
/// not what the law gives, so that such a sample tells a fit nothing; it still warms or cools the
/// joint.
inline Selection WithoutRest(const Selection& selection, const Measurements& measurements) {
  return {selection.keep && measurements.velocity.array() != 0, selection.segments};
}

// The sampling interval of a recording is its median step throughout (MedianStep): gaps and jitter
// leave that as it is.

/// A step of more than this many sampling intervals is a gap: at least three samples in a row are
/// missing, which jitter and a lost sample or two do not make.
inline constexpr double kGapSteps = 3;

/// The longest step between samples that is no gap, s. time: [N] s, N at least 2.
inline double LongestStep(const Eigen::VectorXd& time) { return kGapSteps * MedianStep(time); }

/// Every step that is longer than LongestStep, in order of time. time: [N] s
std::vector<LogGap> GapsOf(const Eigen::VectorXd& time);

/// Samples 0, ..., size - 1, cut in front of each of `starts`, which ascend.
std::vector<SampleRange> CutAt(const std::vector<Eigen::Index>& starts, Eigen::Index size);

/// The pieces of a log between its gaps, in order of time. time: [N] s
std::vector<SampleRange> PiecesOf(const Eigen::VectorXd& time);

/// The piece that holds sample n. pieces: as CutAt makes them
const SampleRange& PieceAt(const std::vector<SampleRange>& pieces, Eigen::Index n);

}  // namespace warmjoint
