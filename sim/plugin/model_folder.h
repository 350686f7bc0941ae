// The folder of the model that is being loaded, which MuJoCo does not tell its plugins.
#pragma once

#include <filesystem>

namespace warmjoint::inline sim {

/// Folder of the model that this thread loaded last; empty where it loaded none that way.
inline std::filesystem::path& ModelFolder() {
  thread_local std::filesystem::path folder;
  return folder;
}

}  // namespace warmjoint::inline sim
