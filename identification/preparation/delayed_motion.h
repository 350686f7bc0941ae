// Motion of any kind, shifted in time to the torque that follows it late.
#pragma once

#include <warmjoint/prepared_log.h>

namespace warmjoint {

/// The motion at t - delay with the torque at t, of a log with its acceleration (PreparedLog::moving): positions and
/// velocities by cubic Hermite polynomials with their known slopes, the acceleration and the motor's position by those through
/// four samples, means between samples by straight lines. Columns that were not measured with the motion, as a load, stay. It
/// keeps the samples around whose t - delay both neighbours are kept; none whose t - delay lies in a gap or outside of its
/// recording. delay: s, below 0 for a torque that comes early
LogView Delayed(const LogView& view, double delay);

/// The same samples; those of the log itself where there is no delay.
LogSamples Delayed(const LogSamples& measurements, const std::optional<double>& delay);

}  // namespace warmjoint
