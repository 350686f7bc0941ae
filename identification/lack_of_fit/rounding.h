// What the steps of a coarse torque sensor leave in a residual.
#pragma once

#include <Eigen/Core>

namespace warmjoint {

/// Mean error of a torque f with white noise of deviation s that is logged in whole steps q,
///
///     e(f) = sum_k (-1)^k q/(pi k) exp(-2 (pi k s/q)^2) sin(2 pi k f/q),
///
/// the Fourier series of the sawtooth round(x) - x, each wave as much smaller as noise evens it out (Widrow and Kollar,
/// Quantization Noise, 2008). It depends on f alone, so that it does not vanish in a mean over many samples where
/// f keeps its value. s^2 is the residual's variance less q^2/12. Empty where the log has no steps, or where noise evens
/// them out to 1e-6 of q (q below 1.1 s). torque: as it was logged, [N] N.m or N; residual: [N] of it; variance: of the
/// residual; returns [N].
Eigen::VectorXd MeanRounding(const Eigen::VectorXd& torque, const Eigen::VectorXd& residual,
                             double variance);

/// The step q of a torque that is logged in steps, by the differences of neighbours (robust_noise.h) or, where the direction
/// changes with each sample, by those of four or more different |torque|. 0 where there are no steps. [N] N.m or N
double StepOf(const Eigen::VectorXd& torque);

/// The step q where steps hide the torque within them, else 0: below s = 0.14 q the mean of what is logged follows less than a
/// hundredth of f in the middle of a step, 2 q/(s sqrt(2 pi)) exp(-q^2 / 8 s^2), and the error may be anything up to q/2.
double HidingStep(const Eigen::VectorXd& torque, double variance);

}  // namespace warmjoint
