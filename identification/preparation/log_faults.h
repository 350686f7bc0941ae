// Contradictions within a log, with which no fit of it can be trusted.
#pragma once

#include <warmjoint/prepared_log.h>
#include <warmjoint/recording.h>

#include <optional>
#include <string>
#include <vector>

#include "models/foundation/robust_noise.h"

namespace warmjoint {

/// The faults of a log, each with a sentence: what, how many, where, the bound, the remedy. Looks at
/// the kept samples, without those of absurd torque, which are a fault of their own. A velocity that was computed
/// from the positions is not compared with them.
std::vector<LogFault> FindFaults(const Measurements& measurements, const Selection& selection,
                                 MotionSource source = MotionSource::velocity);

// The kinds of faults; each function returns nothing where the log has no such fault.

/// Velocity that contradicts position and time along the stretches in which the joint moves (stretches.h),
/// eight or more: integral(v dt) / dp lies more than 2 % from 1, and more than four standard errors;
/// or that of one direction 10 %, where the other does not; or that of three stretches in a row by half from the others.
/// A difference by a filter, a delay, long steps or a coarse column is allowed.
std::optional<std::string> VelocityAgainstPosition(const Measurements& measurements,
                                                   const Selection& selection);

/// Positions and velocities that jump away and come back within ten samples, twice or more: by more than four times what 19 of 20
/// steps and speeds stay below, from a calm step to a calm step, and to within a quarter of the jump of where they were. A spoilt
/// message does that, no joint.
std::optional<std::string> JumpsThatReturn(const Measurements& measurements,
                                           const Selection& selection);

/// Positions that jump back by one and the same way, more than half of their range: those of a
/// sensor that starts again after a range of its own (turns are undone while reading, UndoJumps). Two
/// jumps are needed, equal to 1 %, each more than four times what the speed next to it allows. Where positions run back after
/// most jumps, a bit is their sign.
std::optional<std::string> WrappedPosition(const Measurements& measurements,
                                           const Selection& selection);

/// Torque of the two directions at the same places and speeds, in eight such cells or more: less forwards than backwards
/// in nine cells of ten, where friction resists, so that the sign of one column is wrong; or of one sign throughout, while
/// the directions agree in size, or differ by a power of two of its steps.
std::optional<std::string> TorqueDirections(const Measurements& measurements,
                                            const Selection& selection);

/// Torque that stays small over one and the same way after most reversals, whatever time that takes, and then jumps to its
/// level, in one per cent or more of the samples that a fit takes: all at which the joint moves, or those that are kept in a
/// log that holds speeds. Eight reversals are needed.
std::optional<std::string> Backlash(const Measurements& measurements, const Selection& selection);

/// Torque that stops at a largest or smallest value: ten samples have it, 0.5 % of all, and five
/// times as many as have the value next to it. Torque must be noisy and take 50 values or more:
/// that of a simulation without noise repeats itself too, and coarse steps have few values.
std::optional<std::string> ClippedTorque(const Measurements& measurements,
                                         const Selection& selection);

/// Torque that stays at one value for 20 samples in motion or more, although elsewhere less than one
/// step in twenty is 0 and torque is noisy, or the speed changes meanwhile; of one that comes in steps without noise, the
/// direction.
std::optional<std::string> StuckTorque(const Measurements& measurements,
                                       const Selection& selection);

/// Torque that drops to exactly 0 for a few samples, five times or more, and is far from 0
/// elsewhere: four times fewer samples have less than a quarter of the mean of |torque|, or the
/// smallest size of all.
std::optional<std::string> DroppedTorque(const Measurements& measurements,
                                         const Selection& selection);

/// Samples with absurd torque, [N]: above 10 times what is typical of that speed, where three in a row or one in a hundred
/// are, or above 50 times; in a log that holds no speeds, twice as far. Typical is the median over
/// eight bins of speed. Why: a quarter of the log fills fewer than half of the bins.
SampleMask AbsurdTorque(const Measurements& measurements, const Selection& selection);

/// A sentence on absurd torque: how many samples, when, and the worst.
std::string DescribeAbsurd(const Measurements& measurements, const SampleMask& absurd);

}  // namespace warmjoint
