// The command line as a whole.
#pragma once

#include "tools/cli/command.h"

namespace warmjoint::inline tools {

/// Reads the command line and runs its subcommand. Throws BadInput for arguments that cannot be
/// used, with the nearest known option or subcommand.
ExitStatus RunProgram(int argc, const char* const* argv);

}  // namespace warmjoint::inline tools
