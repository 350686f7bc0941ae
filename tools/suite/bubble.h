// The second choice of a wall: bubblewrap, where the kernel has no Landlock and lets it work.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace warmjoint::inline tools {

/// The file of bubblewrap, where it is installed and a command of the system's runs in it; empty elsewhere: it needs
/// user namespaces, or root, and a container often forbids both. Tried once.
const std::filesystem::path& Bubblewrap();

/// A command within namespaces of its own: it sees `system` and `readable` as they are, to be read, its own directory,
/// processes that it started, and no network. Paths that do not exist are left out.
std::vector<std::string> InBubble(const std::vector<std::string>& command,
                                  const std::vector<std::filesystem::path>& system,
                                  const std::vector<std::filesystem::path>& readable,
                                  const std::filesystem::path& own);

}  // namespace warmjoint::inline tools
