// URDF files, read by urdfdom.
#pragma once

#include <urdf_model/model.h>
#include <urdf_world/types.h>

#include <filesystem>

namespace warmjoint {

/// The robot that a URDF file describes. Throws BadInput with the file's name and what urdfdom
/// refuses.
urdf::ModelInterfaceSharedPtr ReadUrdf(const std::filesystem::path& path);

}  // namespace warmjoint
