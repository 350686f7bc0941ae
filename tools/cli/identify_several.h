// `identify` with several identifiers: a table of their errors on held-out blocks.
#pragma once

#include "tools/cli/command.h"
#include "tools/cli/identify_arguments.h"

namespace warmjoint::inline tools {

/// Tries them on the same blocks and prints how they compare. Throws BadInput for what is meant for one
/// identifier alone.
ExitStatus IdentifySeveral(const IdentifyArguments& arguments);

}  // namespace warmjoint::inline tools
