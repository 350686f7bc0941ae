// How far from chance a sum over parts of a recording is.
#pragma once

#include <Eigen/Core>

namespace warmjoint {

/// The probability that q coefficients differ from 0 together as far as these by chance, where
/// `scatter` [q x q] was summed over `groups` parts of the recording: Hotelling's
/// T^2 = b^T scatter^-1 b, F = T^2 (groups - q)/(q (groups - 1)) with q and groups - q degrees of
/// freedom. 1 where the parts are too few to tell, groups <= q + 2.
double HotellingPValue(const Eigen::VectorXd& coefficients, const Eigen::MatrixXd& scatter,
                       double groups);

}  // namespace warmjoint
