// What code does to the columns of a recording: as a whole, in time, and as the forward model reads them.
#pragma once

#include <warmjoint/recording.h>

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "models/foundation/robust_noise.h"
#include "models/friction/along_motion.h"

namespace warmjoint {

/// Calls use(column) for every column that the log has: the one list of them, for what is done to
/// all alike.
template <typename Log, typename Use>
void ForEachColumn(Log& log, Use&& use) {
  for (auto* column : {&log.time, &log.position, &log.velocity, &log.torque}) use(*column);
  for (auto* column : {&log.motor_position, &log.load, &log.temperature, &log.acceleration,
                       &log.mean_speed, &log.loss_velocity}) {
    if (*column) use(**column);
  }
}

/// The first n samples.
Measurements FirstSamples(Measurements log, Eigen::Index n);

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

/// Samples first, ..., first + count - 1 of a log.
struct SampleRange {
  Eigen::Index first = 0, count = 0;
};

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

/// How a law's own bristle is bent at the start of each recording: as in steady sliding, or as the
/// measured torque tells.
enum class BristleStart { sliding, torque };

/// Time, velocity, positions, load and starts of a recording of N samples. The motor position is
/// the logged one, else the recording's gear times the joint's.
JointCourse CourseOf(const Measurements& measurements,
                     BristleStart bristle = BristleStart::sliding);

/// The friction that a recording's motion gives: AlongMotion over CourseOf.
Prediction PredictFriction(const Friction& friction, const Measurements& measurements,
                           const CourseStart& start = {},
                           BristleStart bristle = BristleStart::sliding);

}  // namespace warmjoint
