#include "sim/model/plugin_libraries.h"

#include <dlfcn.h>
#include <mujoco/mujoco.h>

#include <filesystem>
#include <regex>

namespace warmjoint::inline sim {
namespace {

namespace fs = std::filesystem;

/// The folder of MuJoCo's library; empty where the system does not tell.
fs::path MujocoFolder() {
  Dl_info library{};
  if (dladdr(reinterpret_cast<void*>(&mj_version), &library) == 0) return {};
  return fs::absolute(library.dli_fname).parent_path();
}

bool LoadOnce() {
  const fs::path beside = MujocoFolder();
  if (beside.empty()) return false;
  // folders in which its packages have them
  bool any = false;
  for (const char* folder : {"plugin", "mujoco_plugin", "../bin/mujoco_plugin"}) {
    std::error_code absent;
    if (!fs::is_directory(beside / folder, absent)) continue;
    mj_loadAllPluginLibraries((beside / folder).c_str(), nullptr);
    any = true;
  }
  return any;
}

}  // namespace

bool LoadMujocoPlugins() {
  // once in a process: a second time each would be registered twice
  static bool loaded = false;
  if (loaded) return false;
  loaded = true;
  return LoadOnce();
}

std::string UnknownPlugin(const std::string& message) {
  static const std::regex complaint(
      "[Pp]lugin '?([A-Za-z0-9_.:/-]+)'? not found|"
      "unknown plugin '?([A-Za-z0-9_.:/-]+)'?");
  std::smatch found;
  if (!std::regex_search(message, found, complaint)) return "";
  return found[1].matched ? found[1] : found[2];
}

}  // namespace warmjoint::inline sim
