// position-ridge: a nominal law and a map over the joint's position.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "identification/identifier.h"
#include "models/friction/friction_map.h"

namespace warmjoint::inline identification {

/// Eqs. (10)-(16): law and Gaussian kernels over position, one part for each direction of motion,
/// or over position times velocity.
Identifier PositionRidge();

/// The map that it fits, with the kernels that it chooses, beside a warming that is known; nothing where
/// none can be fitted. energy: [N] E, N.m or N.
std::optional<FrictionMap> MapBesideEnergy(const IdentifierInput& input,
                                           const Eigen::VectorXd& energy);

}  // namespace warmjoint::inline identification
