// Interpreters that PATH hides behind scripts.
#pragma once

#include <filesystem>
#include <string>

namespace warmjoint::inline tools {

/// The file of the program that a command's first word names, as FindProgram has it. Where that word is `python`,
/// `python3` or `python3.N` and PATH gives a script that starts the interpreter from elsewhere (a shim, as pyenv's), behind
/// the wall it could not: then the script is asked, once and without a wall, which interpreter it starts in a directory of
/// its own, and that one is given; the script itself where it does not tell.
std::filesystem::path FindInterpreter(const std::string& word);

}  // namespace warmjoint::inline tools
