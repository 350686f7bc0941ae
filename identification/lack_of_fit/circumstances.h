// The conditions of a joint while a log was recorded, as far as tests for lack of fit need them.
#pragma once

#include <warmjoint/prepared_log.h>

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "identification/lack_of_fit/bins.h"
#include "identification/lack_of_fit/fitted_model.h"

namespace warmjoint {

/// Shapes that a drift of the friction may have: linear in time, and dying away with three time constants; why: these span
/// drifts that are neither linear nor over before the warming.
inline constexpr Eigen::Index kDrifts = 4;

/// dF/dc of forces c f in addition to the fit's, with what their losses change of E, as means over bins. s: sign(v).
struct HeatingForces {
  Eigen::MatrixXd drifts;  // [m x kDrifts] of s d(t), 0 at first and 1 at the end
  Eigen::VectorXd level;   // [m] of s
  Eigen::VectorXd bend;    // [m] of s v^2
  Eigen::MatrixXd slope;   // [m x 1] of v E, E of the fit; [m x 0] where it has no warming
};

/// Means over each bin; [m x 0] where something is not known or not needed.
struct Circumstances {
  Eigen::VectorXd torque;    // [m] tau less gravity, inertia and what a lag adds, N.m or N
  Eigen::VectorXd residual;  // [m] `torque` less F, N.m or N
  HeatingForces heating;     // forces that the fit leaves out
  Eigen::MatrixXd energies;  // [m x 3] measured losses, filtered; N.m or N per unit of gain
  Eigen::MatrixXd initial;   // [m x s] dF/dE(0) of the recordings whose E(0) is taken to be known
  Eigen::MatrixXd loads;     // [m x 2] L, |L|; N.m or N
  Eigen::MatrixXd temperatures;  // [m x 1] degC
  Eigen::MatrixXd weight;  // [m x 2] sin and cos of the position, where the fit leaves a weight out
  Eigen::MatrixXd
      by_recording;  // [m x r (R - 1)] gravity and inertia of each of R recordings but the first
  Eigen::MatrixXd
      late_speeds;  // [m x c] s (|v| after filters of first order - |v|), s: sign(v); rad/s or m/s
  std::vector<double> past;  // [c] their time constants, s
  double duration = 0;       // of the log, s
  double hold = 0;           // median duration of a segment, s; 0 where none are known
};

Circumstances CircumstancesOf(const FittedModel& model, const LogSamples& measurements,
                              const Bins& bins);

/// The speed |v|, rad/s or m/s, of a log in which the joint moves at one speed only: those between its tenth and its ninetieth
/// percentile, rests left out, differ by less than 2 %. What turns with the joint then looks like what is periodic in time for fifty turns.
std::optional<double> OneSpeed(const LogSamples& measurements);

}  // namespace warmjoint
