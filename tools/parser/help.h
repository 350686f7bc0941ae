// Help on the terminal.
#pragma once

#include <string>

#include "tools/parser/command_tree.h"

namespace warmjoint::inline tools {

/// What --help prints, laid out for `width` columns. program: as in UsageOf.
std::string HelpText(const CommandNode& command, const std::string& program, int width);

/// "warmjoint identify": the program's part of it, then the command's own name.
std::string FullName(const CommandNode& command, const std::string& program);

/// "-o, --output FILE", or the name of an argument.
std::string OptionHead(const OptionNode& option);

/// The description with what follows from the rest: "required", "default: csv", "repeatable".
std::string OptionWords(const OptionNode& option);

}  // namespace warmjoint::inline tools
