// Man pages.
#pragma once

#include <string>

#include "tools/parser/command_tree.h"

namespace warmjoint::inline tools {

/// The page of a command, section 1, for man (roff with the macros of man(7)). program: name of the
/// program, with which the names of its subcommands begin; empty for the page of the program itself.
/// version: "warmjoint 0.1.0".
std::string ManPage(const CommandNode& command, const std::string& program,
                    const std::string& version);

/// "warmjoint-run", or "warmjoint": under which man finds the page.
std::string ManName(const CommandNode& command, const std::string& program);

}  // namespace warmjoint::inline tools
