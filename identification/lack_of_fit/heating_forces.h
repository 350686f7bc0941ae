// Forces that a fit leaves out, with the heat that they make.
#pragma once

#include <Eigen/Core>

#include "identification/lack_of_fit/bins.h"
#include "identification/lack_of_fit/fitted_model.h"

namespace warmjoint {

/// Courses that a drift of the friction may take: evenly, and dying away with three time constants; why: these span what
/// is neither even nor over before the warming (heating_forces.cc).
inline constexpr Eigen::Index kCourses = 4;

/// dF/dc of forces c f beside the fit's with what their losses change of E, means over bins. s: sign(v).
struct HeatingForces {
  Eigen::MatrixXd drifts;  // [m x kCourses] of s d(t), 0 at first and 1 at the end
  Eigen::VectorXd level;   // [m] of s
  Eigen::VectorXd bend;    // [m] of s v^2
  Eigen::MatrixXd slope;   // [m x 1] of v E, E of the fit; [m x 0] where it knows no warming
};

HeatingForces HeatingForcesOf(const FittedModel& model, const Measurements& measurements,
                              const Bins& bins);

}  // namespace warmjoint
