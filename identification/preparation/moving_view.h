// A log whose joint moves in any way: its acceleration, and the samples that show friction.
#pragma once

#include <warmjoint/prepared_log.h>

#include <string>
#include <vector>

namespace warmjoint {

/// The speed from which on a joint clearly moves: 5 % of the velocity's root mean square, above its
/// five times its noise and above one and a half of its resolution. rad/s or m/s
double ClearSpeed(const Measurements& measurements);

/// Means from each sample to the next of its piece; of the last one |v| and v. rad/s or m/s
struct BetweenSamples {
  Eigen::VectorXd mean_speed;     // [N] of |v|
  Eigen::VectorXd loss_velocity;  // [N] of v^2 over that of |v|, with the sign of v at the sample
};

/// Viscous friction loses kv v^2 and Coulomb friction kc |v|, so that both means give the loss of a
/// force that is a straight line over speed. The velocity is a straight line between samples, which
/// turns where it passes 0. While the joint moves clearly in one direction, its path is that of the positions,
/// to which all is scaled, so that speeds which bend or jump between samples make no error. Where the
/// positions are not known or contradict the velocity by more than a factor of 2 they are not used.
/// A sample at rest has no friction of its own: the path until the next counts with that one.
/// pieces: of the log without gaps; clear: speed from which on a joint clearly moves, rad/s or m/s.
BetweenSamples MeansBetween(const Measurements& measurements,
                            const std::vector<SampleRange>& pieces, double clear);

/// The log with its acceleration and its means between samples. A velocity whose
/// samples are too noisy for differences of fourth order, and positions in the place of a velocity, are
/// followed by polynomials (local_motion.h), whose velocity takes the place of the samples'. It keeps
/// the samples above ClearSpeed whose neighbours move in the same direction, but for those at a corner
/// of the velocity: where no polynomial fits, or, between differences, where the acceleration
/// jumps by a tenth of its root mean square, and four times as far as in the median. No segments.
LogView ViewMotion(const Measurements& measurements, MotionSource source = MotionSource::velocity);

/// Whether a log shows friction mainly at constant speeds: half or more of the samples in clear motion are kept in segments
/// whose positions, where they are known, change at their speed, to a factor of two, and within which the speed does not mainly
/// drift from one end to the other, as in pieces of a smooth motion that noise hides. Or a tenth of them, where the joint turns
/// between samples so suddenly that half a per cent of its path or more cannot be followed: holds that noise hides in part.
bool HoldsSpeeds(const Measurements& measurements, const Selection& selection,
                 MotionSource source = MotionSource::velocity);

/// Motion of any kind, and what was done to the velocity column for it: a clause, or nothing.
struct FollowedMotion {
  LogView view;
  std::string done;
};

/// ViewMotion of a log's own velocity; of its positions instead, where the column lags these or has an offset (column_lag.h)
/// and they leave half as many samples at least.
FollowedMotion FollowMotion(const Measurements& measurements, MotionSource source);

}  // namespace warmjoint
