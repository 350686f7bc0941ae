// A log whose joint moves in any way: its acceleration, and the samples that show friction.
#pragma once

#include "identification/preparation/log_view.h"

namespace warmjoint::inline identification {

/// The speed from which on a sample moves clearly: 5 % of the velocity's root mean square, above its
/// noise five times and above one and a half of its resolution. rad/s or m/s
double ClearSpeed(const Measurements& measurements);

/// dv/dt, recording by recording and between gaps: slopes of straight lines through 2 w + 1 samples,
/// central differences where w = 1. w is the smallest of 1, 2, 4, ... 32 with which the noise of the
/// velocity leaves 5 % of the acceleration's root mean square or less. [N] rad/s^2 or m/s^2
Eigen::VectorXd Acceleration(const Measurements& measurements);

/// The log with its acceleration and its means between samples (between_samples.h). It keeps the samples above ClearSpeed whose neighbours move in the
/// same direction, but for those at which the acceleration jumps, where its slope is that of neither
/// side: by a tenth of its root mean square, and four times as far as in the median. No segments.
LogView ViewMotion(const Measurements& measurements);

}  // namespace warmjoint::inline identification
