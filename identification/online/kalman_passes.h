// Passes of a bank of Kalman filters over a stored recording.
#pragma once

#include <warmjoint/recording.h>

#include <Eigen/Core>
#include <array>
#include <vector>

#include "identification/fit.h"
#include "identification/forward/closed_loop.h"

namespace warmjoint {

/// The recording as the filters read it, and what it tells beforehand.
struct KalmanTrack {
  const Law& law;
  const Measurements& measurements;
  const Selection& selection;
  ClosedLoop loop;
  Eigen::VectorXd column_rms;  // [d] of the law's columns over the kept samples
  double torque_rms = 0;       // over the kept samples, N.m or N
};

/// Where the filters stand after a pass.
struct KalmanPass {
  Eigen::VectorXd mean;        // [d + 3] p, k, ln tau, E
  Eigen::MatrixXd covariance;  // [d + 3 x d + 3]
  double spacing = 0;          // of the bank, in ln tau
  double noise = 0;            // variance, (N.m)^2 or N^2
};

/// Time constants that a recording can show, s: two steps, or a 500th of it, to 5 times its length.
std::array<double, 2> TimeConstantRange(const KalmanTrack& track);

/// Passes until one moves no parameter by more than a tenth of its standard deviation, `most` at
/// most; where each of them ended. The first knows nothing but E = 0; each later one is linearised
/// where the last one ended, with deviations ten times as great. trace: p, k, tau and E at 50
/// moments of the last pass.
std::vector<KalmanPass> RunPasses(const KalmanTrack& track, int most, std::vector<Iterate>& trace);

}  // namespace warmjoint
