// Normalised parameter error, Eq. (26).
#pragma once

#include <Eigen/Core>

namespace warmjoint::inline identification {

/// NPE = sqrt(sum_i ((estimate_i - truth_i) / |truth_i|)^2), Eq. (26); 0.05 is 5 %.
/// estimate, truth: [d], the same parameters in the same order; truth_i != 0.
double NormalisedParameterError(const Eigen::VectorXd& estimate, const Eigen::VectorXd& truth);

}  // namespace warmjoint::inline identification
