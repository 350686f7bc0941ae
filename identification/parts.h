// The parts of a recording over which scatter is taken, whatever the colour of the noise within them.
#pragma once

#include <Eigen/Core>

namespace warmjoint {

/// Parts of a recording that count as independent of each other: noise may be coloured within them.
inline constexpr Eigen::Index kParts = 32;

}  // namespace warmjoint
