// One step of the extended Kalman filter for warm friction.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "models/friction/thermal.h"

namespace warmjoint {

/// What is known of (p, k, ln tau, E): the d = D parameters of a linear law, the thermal gain and
/// time constant, and the energy now. D may be Eigen::Dynamic; only then a step allocates.
template <int D>
struct KalmanState {
  static constexpr int kSize = D == Eigen::Dynamic ? D : D + 3;
  Eigen::Matrix<double, kSize, 1> mean;            // [d + 3]
  Eigen::Matrix<double, kSize, kSize> covariance;  // [d + 3 x d + 3]
};

/// One sample and the interval that follows it.
template <int D>
struct KalmanSample {
  Eigen::Matrix<double, D, 1> levels;  // [d] g = sign(v) dFn/dp
  double speed = 0;                    // |v|, rad/s or m/s
  double level = 0;                    // sign(v) torque, N.m or N
  bool measured = false;               // whether the torque is friction alone, Eq. (6)
  double step = 0;                     // s until the next sample
};

/// The state at the next sample, and how the measurement compared with what was expected of it.
template <int D>
struct KalmanOutcome {
  KalmanState<D> state;
  double innovation = 0;  // measured less expected level, N.m or N; 0 where not measured
  double variance = 0;    // that it was expected to have; 0 where not measured
};

/// Takes in sign(v) tau = g . p + E + noise, which the state enters linearly.
template <int D>
void Correct(const KalmanSample<D>& sample, double noise, KalmanOutcome<D>& outcome) {
  auto& [mean, covariance] = outcome.state;
  const Eigen::Index d = sample.levels.size();
  const Eigen::Matrix<double, KalmanState<D>::kSize, 1> Pa =
      covariance.template leftCols<D>(d) * sample.levels + covariance.col(d + 2);
  outcome.innovation = sample.level - sample.levels.dot(mean.template head<D>(d)) - mean[d + 2];
  outcome.variance = noise + sample.levels.dot(Pa.template head<D>(d)) + Pa[d + 2];
  mean += (outcome.innovation / outcome.variance) * Pa;
  const auto scaled = ((1 / outcome.variance) * Pa).eval();
  covariance.noalias() -= scaled * Pa.transpose();
}

/// Moves E over one interval; p, k and ln tau stay.
template <int D>
void Predict(const KalmanSample<D>& sample, KalmanState<D>& state) {
  auto& [mean, covariance] = state;
  const Eigen::Index d = sample.levels.size();
  const double gain = mean[d];
  const ThermalHold<> hold = HoldOver(sample.step, std::exp(mean[d + 1]));
  const double energy = mean[d + 2];
  const double loss = sample.speed * (sample.levels.dot(mean.template head<D>(d)) + energy);

  // the row of E in the Jacobian of the motion; the others are those of the identity
  Eigen::Matrix<double, KalmanState<D>::kSize, 1> row(d + 3);
  row.template head<D>(d) = gain * hold.cooling * sample.speed * sample.levels;
  row[d] = hold.cooling * loss;
  row[d + 1] = hold.Slope() * (energy - gain * loss);
  row[d + 2] = hold.pole + gain * hold.cooling * sample.speed;

  const Eigen::Matrix<double, KalmanState<D>::kSize, 1> cross = covariance * row;
  covariance.row(d + 2) = cross.transpose();
  covariance.col(d + 2) = cross;
  covariance(d + 2, d + 2) = row.dot(cross);
  mean[d + 2] = ThermalStep(gain * hold.cooling, hold.pole, energy, loss);
}

/// One step, a pure function of its arguments. First the measurement, where there is one; then the
/// motion
///   E <- te E + k (1 - te) |v| (g . p + E),  te = exp(-h/tau),
/// which are Eqs. (20) and (22) with (19). E has no noise of its own: it follows from the
/// parameters, and the covariance carries how (Ljung 1979: the filter then descends on the
/// prediction error). noise: variance of the torque's noise, (N.m)^2 or N^2.
template <int D>
KalmanOutcome<D> KalmanStep(const KalmanState<D>& state, const KalmanSample<D>& sample,
                            double noise) {
  KalmanOutcome<D> outcome{state};
  if (sample.measured) Correct(sample, noise, outcome);
  Predict(sample, outcome.state);
  return outcome;
}

}  // namespace warmjoint
