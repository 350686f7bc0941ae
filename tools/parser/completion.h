// Completion of the command line for shells.
#pragma once

#include <string>

#include "tools/parser/command_tree.h"

namespace warmjoint::inline tools {

/// A script that bash reads: subcommands, options, choices, files, and the names of suites, identifiers,
/// laws and robots, which it asks the program for (`list FAMILY --format names`).
///
/// What stands for a value in help (OptionNode::value) says how it is completed: FILE and SOURCE by
/// files, DIR and RUN by folders, SUITE, IDENTIFIER, ROBOT and MODEL by names of their family and by files,
/// MEMBER by names of the family that stands before it, COMMAND by subcommands, JOINT=FILE by files behind the '='.
std::string BashCompletion(const CommandNode& program);

/// The same as a function of zsh's completion system, for a file `_warmjoint` in its fpath.
std::string ZshCompletion(const CommandNode& program);

}  // namespace warmjoint::inline tools
