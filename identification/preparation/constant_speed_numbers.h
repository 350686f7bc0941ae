// The numbers of the selection of constant speed. README.md tells the method and what each of them moves.
#pragma once

#include <Eigen/Core>

namespace warmjoint::constant_speed {

// how far a sample may lie from a speed; the largest of noise, share and resolution counts (why: README.md)
inline constexpr double kFar = 4;      // deviations of the noise: 1 in 16 000 lies further
inline constexpr double kNear = 3;     // the same for what is at rest, or has settled: 1 in 370
inline constexpr double kBand = 0.02;  // of the speed: what a hold may stray
inline constexpr double kSettled =
    0.005;                               // of the speed: to which a start must settle, and a drift
inline constexpr double kLevels = 1.5;   // steps of a quantised velocity: to the neighbouring one
inline constexpr double kAtRest = 1e-3;  // of the velocity's rms
inline constexpr double kMostStrays =
    0.98;  // of the samples in the middle, for the ripple of a hold
inline constexpr double kDriftOfBand = 0.6;  // a hold that drifts by more leaves its band
inline constexpr double kSlowly =
    0.01;  // of the steepest acceleration: a hold that drifts, no ramp

// a jump from one speed to the next
inline constexpr double kJumpDeviations = 8;   // of the noise
inline constexpr double kJumpOverBeside = 10;  // times the changes before and behind it
inline constexpr double kClearJump = 0.5;      // of the step between two speeds

// lengths of runs, in samples or as one over the other (why: README.md)
inline constexpr Eigen::Index kShortest = 3;  // samples of a hold
inline constexpr Eigen::Index kHandful = 20;  // samples, of which fewer show no ripple
inline constexpr Eigen::Index kCalm = 50;  // one in as many of a run must follow each other settled
inline constexpr Eigen::Index kMuchShorter =
    3;  // times: neighbours that are part of an acceleration
inline constexpr Eigen::Index kTurningPoint = 5;  // times shorter than the ramps beside it
inline constexpr Eigen::Index kReversal = 10;     // times shorter than the holds beside it
inline constexpr Eigen::Index kOutliers = 10;     // times shorter than the runs that they divide
inline constexpr Eigen::Index kOfTheRamp =
    10;  // one in as many of a ramp's samples is cut at each end
inline constexpr Eigen::Index kMostCut = 4;  // but no more than one in as many of the hold

}  // namespace warmjoint::constant_speed
