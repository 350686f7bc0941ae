// How far from chance a sum over parts of a recording is.
#pragma once

#include <Eigen/Core>

namespace warmjoint::inline identification {

/// The z-score (uncertainty/tails.h) by which q coefficients differ from 0 together, where `scatter` [q x q] was
/// summed over `groups` parts of the recording: Hotelling's T^2 = b^T scatter^-1 b. 0 where the
/// parts are too few to tell, groups <= q + 2.
double HotellingDeviations(const Eigen::VectorXd& coefficients, const Eigen::MatrixXd& scatter,
                           double groups);

}  // namespace warmjoint::inline identification
