// What is said of a command line that cannot be read.
#pragma once

#include <CLI/CLI.hpp>

namespace warmjoint::inline tools {

/// Throws BadInput for arguments that the parser refused: with the nearest known option or subcommand, the
/// subcommand that an option belongs to, or what an option or argument that is missing stands for.
[[noreturn]] void RefuseArguments(const CLI::App& program, const CLI::ParseError& error);

}  // namespace warmjoint::inline tools
