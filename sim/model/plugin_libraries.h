// Plugins of others that a model asks for.
#pragma once

#include <string>

namespace warmjoint::inline sim {

/// Loads, the first time that it is called, the plugin libraries that MuJoCo itself comes with:
/// those in the folder `plugin` (wheel) or `mujoco_plugin` (release archive) beside its library or
/// in ../bin. No other folder is looked at: loading a library runs it.
/// Returns whether this call loaded any.
bool LoadMujocoPlugins();

/// The plugin that a message of MuJoCo calls unknown; empty where it complains of something else.
std::string UnknownPlugin(const std::string& message);

}  // namespace warmjoint::inline sim
