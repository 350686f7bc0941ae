// Features over bins that a residual may depend on. s = sign(v), u = |v|/max|v|, t: share of the log.
#pragma once

#include "identification/lack_of_fit/circumstances.h"
#include "identification/lack_of_fit/growing_fit.h"

namespace warmjoint {

/// 1, |v|: friction that differs between the directions.
Features OfDirection(const Bins& bins, const Circumstances& circumstances, const GrowingFit& fit);
/// s u^2, s exp(-u/0.1), s exp(-u/0.3): a curve over speed.
Features OfSpeed(const Bins& bins, const Circumstances& circumstances, const GrowingFit& fit);
/// s E with three time constants: friction that changes with the losses.
Features OfEnergy(const Bins& bins, const Circumstances& circumstances, const GrowingFit& fit);
/// v E of the fit, with what its losses change of E: a slope over speed that changes with the heat.
Features OfSpeedByEnergy(const Bins& bins, const Circumstances& circumstances,
                         const GrowingFit& fit);
/// dF/dE(0): a start that was not as warm as assumed.
Features OfInitialEnergy(const Bins& bins, const Circumstances& circumstances,
                         const GrowingFit& fit);
/// s L, s |L|, L.
Features OfLoad(const Bins& bins, const Circumstances& circumstances, const GrowingFit& fit);
/// sin q, cos q: the weight of a joint, of a fit without gravity.
Features OfGravity(const Bins& bins, const Circumstances& circumstances, const GrowingFit& fit);
/// sin q, cos q, a, each in one recording: gravity and inertia that differ between recordings.
Features OfRecording(const Bins& bins, const Circumstances& circumstances, const GrowingFit& fit);
/// s T, T the measured temperature.
Features OfTemperature(const Bins& bins, const Circumstances& circumstances, const GrowingFit& fit);
/// s cos(k pi t), k = 1..4; cos(k pi t), k = 1, 2: slow drift.
Features OfTime(const Bins& bins, const Circumstances& circumstances, const GrowingFit& fit);
/// s (u - |v|), u: |v| after a filter of first order, the best of Circumstances::past: friction that follows the speed
/// late, and agrees with the law at a steady speed.
Features OfSpeedMemory(const Bins& bins, const Circumstances& circumstances, const GrowingFit& fit);
/// s or 1 from one of 31 places in the log on: friction or offset that jumps.
Features OfStep(const Bins& bins, const Circumstances& circumstances, const GrowingFit& fit);
/// c, s c, and s or 1 times cos(pi x), sin(pi x); x: holds passed, c = 1 in even holds, -1 in odd
/// ones: structure that alternates from hold to hold.
Features OfHoldParity(const Bins& bins, const Circumstances& circumstances, const GrowingFit& fit);
/// s or 1 times y - 1/2, cos(2 pi y); y: share of the hold: structure that changes within each hold in the same way.
Features OfHoldPhase(const Bins& bins, const Circumstances& circumstances, const GrowingFit& fit);
/// s or 1 times cos(2 pi f t), sin(2 pi f t): what is periodic in time. f in steps of half a cycle
/// over the log, from 2.5 cycles to one a hold, four bins a cycle at least.
Features OfPeriod(const Bins& bins, const Circumstances& circumstances, const GrowingFit& fit);

}  // namespace warmjoint
