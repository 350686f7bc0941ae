// Files that commands of others name.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace warmjoint::inline tools {

/// The words of a command that is to run elsewhere: those that name an existing file, seen from
/// `folder`, become absolute. The first one is a program: without a folder in it, it is looked for in
/// PATH first, as a shell does.
std::vector<std::string> WithAbsoluteFiles(std::vector<std::string> words,
                                           const std::filesystem::path& folder);

/// The same for a line of a shell: parted by blanks alone, and quoted where they need it. All else stays
/// as it is.
std::string WithAbsoluteFiles(const std::string& line, const std::filesystem::path& folder);

}  // namespace warmjoint::inline tools
