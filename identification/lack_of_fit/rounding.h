// What the steps of a coarse torque sensor leave in a residual.
#pragma once

#include <warmjoint/recording.h>

#include <Eigen/Core>

namespace warmjoint {

/// The step q of a torque that is logged in steps, by the differences of neighbours (robust_noise.h) or, where most neighbours
/// repeat, by those of four or more different |torque|, or the largest one that fewer are whole multiples of. 0 where there are no steps.
/// [N] N.m or N
double StepOf(const Eigen::VectorXd& torque);

/// A torque f with white noise of deviation s that is logged in whole steps q, as round(f + n). Its mean error is
///
///     e(f) = sum_k (-1)^k q/(pi k) E_k sin(2 pi k f/q),  E_k = exp(-2 (pi k s/q)^2),
///
/// the Fourier series of the sawtooth round(x) - x, each wave as much smaller as noise evens it out (Widrow and Kollar,
/// Quantization Noise, 2008), and its mean square error
///
///     s^2 + q^2/12 + sum_k (-1)^k (q^2/(pi k)^2 + 4 s^2) E_k cos(2 pi k f/q),
///
/// of which the residual's variance gives s. e depends on f alone, so that it does not vanish in a mean over many samples
/// where f keeps its value.
class RoundedTorque {
 public:
  /// torque: [N] as it was logged, N.m or N; residual: [N] of f; selection: of the samples whose residual gives the noise
  RoundedTorque(const Eigen::VectorXd& torque, const Eigen::VectorXd& residual,
                const Selection& selection);

  double step() const { return step_; }  // q, N.m or N; 0: it has no steps

  /// Whether noise evens the steps out, to 1e-6 of q (q below 1.1 s), or there are none.
  bool IsEven() const;
  /// Whether steps hide the torque within them: below s = 0.14 q the mean of what is logged follows less than a hundredth of f in
  /// the middle of a step, 2 q/(s sqrt(2 pi)) exp(-q^2 / 8 s^2). s is the smaller of two estimates: structure makes that by the
  /// residual too large, and motion that by how often neighbours differ by a step.
  bool IsHidden() const;

  /// e(f). [N] N.m or N
  Eigen::VectorXd MeanError() const;

 private:
  double step_ = 0;
  double noise_ = 0;          // s/q by the residual
  double of_neighbours_ = 0;  // s/q by neighbours
  Eigen::ArrayXd place_;      // [N] f/q, counted from a torque that was logged
};

}  // namespace warmjoint
