// A URDF, read by urdfdom, as an mjSpec: kinematics and inertials alone.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/model/spec_elements.h"

namespace warmjoint {

/// Links become bodies and joints hinges and slides; those that float or slide in a plane stand still. Of elements that stand twice
/// the first counts. Inertias that are none of a body (an eigenvalue below 0 or larger than the sum of the others) become
/// the nearest that are, a moving link without mass gets a very small one; each is said in `notices`. Throws BadInput.
SpecPtr SpecOfUrdf(const std::filesystem::path& file, std::vector<std::string>& notices);

}  // namespace warmjoint
