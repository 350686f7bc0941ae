// Velocity and acceleration of a joint from noisy samples, without smoothing over corners of the motion.
#pragma once

#include <warmjoint/prepared_log.h>

#include <Eigen/Core>
#include <vector>

#include "models/foundation/robust_noise.h"
#include "models/recording/measurements.h"

namespace warmjoint {

/// Noise of an acceleration that is accepted, as a share of the acceleration's root mean square.
inline constexpr double kAcceptedNoise = 0.05;

/// Speed from which on a joint clearly moves; why: tests/studies/preparation.md.
inline constexpr double kClear = 0.05;  // of the velocity's root mean square

struct LocalMotion {
  Eigen::VectorXd velocity;      // [N] rad/s or m/s
  Eigen::VectorXd acceleration;  // [N] rad/s^2 or m/s^2
  /// [N] whether both are known: a polynomial passes through the samples around, but for their noise.
  SampleMask known;
};

/// Samples at which the joint moves, faster than 5 % of the velocity's root mean square. Figures of a
/// motion (its noise, its acceleration, how much that changes) are computed from these: a rest, whose velocity many drives
/// log as zeros, would make them small. velocity: [N] rad/s or m/s
SampleMask InMotion(const Eigen::VectorXd& velocity);

/// The samples of `known` that are at no corner of the velocity: where the acceleration changes from one side of a sample to
/// the other by no more than a tenth of its root mean square, four times the median change of the samples `moving`, or five
/// times the noise of a change; and so at the neighbours, whose acceleration spans it.
/// changes: [N] rad/s^2 or m/s^2, as are rms, of the acceleration, and noise, of a change.
SampleMask AwayFromCorners(const SampleMask& known, const Eigen::VectorXd& changes,
                           const SampleMask& moving, double rms, double noise);

/// Step of a quantised velocity, rad/s or m/s; 0 where it is not quantised. Ramps of one slope between
/// constant speeds change by one step, too, but sample after sample.
double StepOfVelocity(const Eigen::VectorXd& velocity);

/// Standard deviation of the velocity's samples in motion, rounding included, rad/s or m/s.
double NoiseOfVelocity(const Eigen::VectorXd& velocity);

/// Polynomials by least squares (Savitzky and Golay 1964) through the 2 w + 1 samples around each: of
/// fifth degree through velocities, of sixth degree through positions, so that both see the same
/// bends; less by two where w is below 6. w is the smallest with which noise leaves kAcceptedNoise of the acceleration or less.
/// Around a corner of the velocity each sample takes the largest smaller w whose polynomial passes
/// within the noise, by chi^2 at one in a thousand (the rule of Lepski 1990: the widest window
/// that no misfit contradicts); what lies nearer to a corner than the smallest window is not known.
/// Misfits below what kAcceptedNoise allows the noise are accepted, too. Through few samples a polynomial
/// bends from one slope to the other within that: where the acceleration still changes from one side of a
/// sample to the other by a tenth of its root mean square, four times as much as in the median, and five
/// times its noise, it is not known either, nor are the neighbours of such samples.
/// Positions whose stamps jitter have the jitter times their speed as further noise.
/// pieces: of the log without gaps.
LocalMotion FollowLocally(const Measurements& measurements, const std::vector<SampleRange>& pieces,
                          MotionSource source);

}  // namespace warmjoint
