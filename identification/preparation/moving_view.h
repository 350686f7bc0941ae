// A log whose joint moves in any way: its acceleration, and the samples that show friction.
#pragma once

#include <warmjoint/prepared_log.h>

namespace warmjoint {

/// The speed from which on a sample moves clearly: 5 % of the velocity's root mean square, above its
/// noise five times and above one and a half of its resolution. rad/s or m/s
double ClearSpeed(const Measurements& measurements);

/// The log with its acceleration and its means between samples (between_samples.h). A velocity whose
/// samples are too noisy for differences of fourth order, and positions in the place of a velocity, are
/// followed by polynomials (local_motion.h), whose velocity takes the place of the samples'. It keeps
/// the samples above ClearSpeed whose neighbours move in the same direction, but for those at a corner
/// of the velocity: where no polynomial fits, or, between differences, where the acceleration
/// jumps by a tenth of its root mean square, and four times as far as in the median. No segments.
LogView ViewMotion(const Measurements& measurements, MotionSource source = MotionSource::velocity);

/// A log as fits to motion of any kind see it: ViewMotion of how it was taken. Made when it is first
/// asked for, and kept with the log.
const LogView& MovingView(const PreparedLog& log);

/// Whether constant speeds are what a log shows of friction: a tenth or more of what moves clearly moves
/// at a constant speed.
bool HoldsSpeeds(const Measurements& measurements, const Selection& selection);
bool HoldsSpeeds(const PreparedLog& log);

}  // namespace warmjoint
