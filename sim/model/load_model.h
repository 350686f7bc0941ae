// MuJoCo models from MJCF and URDF files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "models/foundation/bad_input.h"
#include "sim/model/mujoco_handles.h"

namespace warmjoint::inline sim {

/// A model as read, open to changes, with what was left out so that it loads.
struct ParsedModel {
  SpecPtr spec;
  std::vector<std::string> notices;  // one sentence each
};

/// Reads an MJCF or URDF file. Meshes of a URDF that are named by `package://`, which only ROS can
/// resolve, are left out with one notice. Throws BadInput with file and, where MuJoCo tells it,
/// line for an unreadable file, and with the link's name for a URDF with a moving link that has
/// no mass.
ParsedModel ParseModel(const std::filesystem::path& path);

/// Compiles a model. Throws BadInput from `place` with what MuJoCo or a plugin refuses.
ModelPtr CompileModel(mjSpec& spec, const Place& place);

/// A compiled model and the notices of its reading.
struct LoadedModel {
  ModelPtr model;
  std::vector<std::string> notices;
};

/// ParseModel and CompileModel in one.
LoadedModel LoadModel(const std::filesystem::path& path);

}  // namespace warmjoint::inline sim
