// One step of the extended Kalman filter for warm friction.
#pragma once

#include <Eigen/Core>

namespace warmjoint {

/// What is known of (p, k, ln tau, E): the d parameters of a linear law, the thermal gain and time
/// constant, and the energy now.
struct KalmanState {
  Eigen::VectorXd mean;        // [d + 3]
  Eigen::MatrixXd covariance;  // [d + 3 x d + 3]
};

/// One sample and the interval that follows it.
struct KalmanSample {
  Eigen::VectorXd levels;  // [d] g = sign(v) dFn/dp
  double speed = 0;        // |v|, rad/s or m/s
  double level = 0;        // sign(v) torque, N.m or N
  bool measured = false;   // whether the torque is friction alone, Eq. (6)
  double step = 0;         // s until the next sample
};

/// What the filter assumes.
struct KalmanNoise {
  double torque = 0;      // variance of the torque's noise, (N.m)^2 or N^2
  Eigen::VectorXd drift;  // [d + 3] variance that each entry of the state gains in a second
};

/// The state at the next sample, a pure function of its arguments. First the measurement
/// sign(v) tau = g . p + E + noise, where there is one; then the motion
///   E <- te E + k (1 - te) |v| (g . p + E),  te = exp(-h/tau),
/// which are Eqs. (20) and (22) with (19), and p, k, ln tau stay.
KalmanState KalmanStep(const KalmanState& state, const KalmanSample& sample,
                       const KalmanNoise& noise);

}  // namespace warmjoint
