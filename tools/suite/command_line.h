// Commands of others as lists of arguments.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "models/foundation/bad_input.h"

namespace warmjoint::inline tools {

/// The words of a command: blanks part them, '...' and "..." hold them together, a backslash takes the
/// next character as it is. Nothing is expanded. Throws BadInput from `place` for a quote without
/// its end.
std::vector<std::string> SplitCommand(const std::string& command, const Place& place);

/// The inverse: a text that SplitCommand, and a shell as well, reads as these words.
std::string JoinCommand(const std::vector<std::string>& words);

/// The text with every `from` replaced.
std::string Replaced(std::string text, const std::string& from, const std::string& to);

/// The words of a command that is to run elsewhere: those that name an existing file, seen from
/// `folder`, become absolute. The first one is a program: without a folder in it, it is looked for in
/// PATH first, as a shell does.
std::vector<std::string> WithAbsoluteFiles(std::vector<std::string> words,
                                           const std::filesystem::path& folder);

/// The same for a line of a shell: parted by blanks alone, and quoted where they need it. All else stays
/// as it is.
std::string WithAbsoluteFiles(const std::string& line, const std::filesystem::path& folder);

}  // namespace warmjoint::inline tools
