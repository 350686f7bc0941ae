// What a joint went through while a log was recorded, as far as tests for lack of fit ask about it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/lack_of_fit/bins.h"
#include "identification/lack_of_fit/fitted_model.h"
#include "identification/lack_of_fit/heating_forces.h"

namespace warmjoint {

/// Means over each bin; [m x 0] where something is not known or not asked.
struct Circumstances {
  Eigen::VectorXd torque;        // [m] tau less gravity, inertia and what a lag adds, N.m or N
  Eigen::VectorXd residual;      // [m] that less F, N.m or N
  HeatingForces heating;         // forces that the fit leaves out
  Eigen::MatrixXd energies;      // [m x 3] measured losses, filtered; N.m or N per unit of gain
  Eigen::MatrixXd initial;       // [m x 1] dF/dE(0), where E(0) is taken to be known
  Eigen::MatrixXd loads;         // [m x 2] L, |L|; N.m or N
  Eigen::MatrixXd temperatures;  // [m x 1] degC
  Eigen::MatrixXd
      late_speeds;  // [m x c] s (|v| behind filters of first order - |v|), s: sign(v); rad/s or m/s
  std::vector<double> past;  // [c] their time constants, s
  double duration = 0;       // of the log, s
  double hold = 0;           // median duration of a segment, s; 0 where none are known
};

Circumstances CircumstancesOf(const FittedModel& model, const Measurements& measurements,
                              const Bins& bins);

}  // namespace warmjoint
