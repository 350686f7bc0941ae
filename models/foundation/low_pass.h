// Low-pass filters of sampled signals: of first order, and Butterworth ones as second-order sections.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace warmjoint {

/// How much of a step a first-order low-pass has followed after `step` s: 1 - exp(-step / T).
double ShareFollowed(double step, double time_constant);

/// x behind a first-order low-pass that each sample's value drives until the next one:
/// y[0] = x[0], y[i] = y[i-1] + (1 - exp(-(t[i] - t[i-1]) / T)) (x[i-1] - y[i-1]).
/// time: [N] s, increasing; x: [N]; time_constant: T > 0, s.
Eigen::VectorXd LowPass(const Eigen::VectorXd& time, const Eigen::VectorXd& x,
                        double time_constant);

/// y[i] = b0 x[i] + b1 x[i-1] + b2 x[i-2] - a1 y[i-1] - a2 y[i-2].
struct Biquad {
  double b0 = 1, b1 = 0, b2 = 0, a1 = 0, a2 = 0;
};

/// Digital Butterworth low-pass, |H(f)|^2 = 1 / (1 + (tan(pi f/rate) / tan(pi cutoff/rate))^(2n)):
/// the analogue prototype through the bilinear transform, its corner kept at `cutoff`. Unit gain at
/// 0 Hz. order: n, even; cutoff, rate: Hz, 0 < cutoff < rate / 2. Returns n / 2 sections.
std::vector<Biquad> ButterworthLowPass(int order, double cutoff, double rate);

/// The sections in a row as a causal filter that is fed sample by sample.
class BiquadCascade {
 public:
  explicit BiquadCascade(std::vector<Biquad> sections);

  /// Puts the filter into its steady state for the constant input x.
  void Settle(double x);
  /// One sample in, one out.
  double Step(double x);

 private:
  std::vector<Biquad> sections_;
  std::vector<Eigen::Vector2d> memory_;  // transposed direct form II, one pair a section
};

/// Runs the filter forwards and backwards: no phase shift, |H|^2 as gain. The ends are continued by
/// point reflection, which keeps their slope. x: [N]; returns [N].
Eigen::VectorXd FilterZeroPhase(const std::vector<Biquad>& sections, const Eigen::VectorXd& x);

}  // namespace warmjoint
