// What in a log contradicts itself, so that no fit of it can be trusted.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "models/recording/measurements.h"
#include "models/recording/selection.h"

namespace warmjoint::inline identification {

/// The faults of a log, each one sentence: what, how many, where, the bound, the remedy. Looks at
/// the kept samples. One pass or two over the samples for each kind of fault.
std::vector<std::string> FindFaults(const Measurements& measurements, const Selection& selection);

// The kinds, each nothing where the log is free of it.

/// Velocity that contradicts position and time: the median over the segments of dp / integral(v dt)
/// (trapezoids) lies more than 2 % from 1, and more than four standard errors of that median. A
/// segment counts where its positions stray from a straight line by less than 0.3 % of its way
/// (rms), so that neither noise nor resolution matters; three are needed, and a third of all
/// segments.
std::optional<std::string> VelocityAgainstPosition(const Measurements& measurements,
                                                   const Selection& selection);

/// Positions that jump back by one and the same way, more than half of their range: those of a
/// sensor that starts again after a range of its own (turns are undone while reading, unwrap.h). Two
/// jumps are needed, equal to 1 %, each more than four times what the speed beside it allows.
std::optional<std::string> WrappedPosition(const Measurements& measurements,
                                           const Selection& selection);

/// Torque against the motion in more than 95 % of the kept samples of nine segments in ten, five
/// segments or more: friction resists, so the sign of one column is wrong.
std::optional<std::string> TorqueSign(const Measurements& measurements, const Selection& selection);

/// Torque that stops at a largest or smallest value: ten samples have it, 0.5 % of all, and five
/// times as many as have the value next to it. Torque must be noisy and take 50 values or more:
/// that of a simulation without noise repeats itself too, and coarse steps have few values.
std::optional<std::string> ClippedTorque(const Measurements& measurements,
                                         const Selection& selection);

/// Torque that stays at one value for 20 moving samples or more, although elsewhere less than one
/// step in twenty is 0 and torque is noisy, or the speed changes meanwhile; of one that comes in steps without noise, the
/// direction.
std::optional<std::string> StuckTorque(const Measurements& measurements,
                                       const Selection& selection);

/// Torque that drops to exactly 0 for a few samples, five times or more, and is far from 0
/// elsewhere: four times fewer samples have less than a quarter of the mean of |torque|, or the
/// smallest size of all.
std::optional<std::string> DroppedTorque(const Measurements& measurements,
                                         const Selection& selection);

/// Torque above 50 times the 99 % quantile of |torque|.
std::optional<std::string> AbsurdTorque(const Measurements& measurements,
                                        const Selection& selection);

}  // namespace warmjoint::inline identification
