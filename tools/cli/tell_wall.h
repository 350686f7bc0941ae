// What keeps commands of others from what they must not see, told before they run.
#pragma once

#include <filesystem>
#include <vector>

#include "scenarios/suite_identifier.h"

namespace warmjoint::inline tools {

/// Says on stderr which wall stands around the commands among the identifiers, if there are any, and warns
/// of each of `secrets` that one of them can read.
void TellWall(const std::vector<SuiteIdentifier>& identifiers,
              const std::vector<std::filesystem::path>& secrets);

}  // namespace warmjoint::inline tools
