// Meshes of a URDF: where they lie, and which of them MuJoCo can read.
#pragma once

#include <mujoco/mujoco.h>
#include <warmjoint/attach.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "models/foundation/bad_input.h"

namespace warmjoint {

/// The text of a URDF with MuJoCo told to keep what is only to be seen, unless the text itself says
/// what to do with that (`discardvisual`); by default MuJoCo leaves it out of a URDF.
std::string KeepVisuals(std::string urdf);

/// Points the meshes of a URDF that was read to their files, named by a path, by `file://` or by
/// `package://`, seen from the URDF's folder. Left out,
/// with their shapes, are those of packages that `packages` does not hold, those whose format
/// MuJoCo cannot read (it reads stl, obj and msh), and those that are only to be seen and have no
/// file. Returns a sentence for each of these three. Throws BadInput from `place` for a file that
/// a given package lacks.
std::vector<std::string> ResolveMeshes(mjSpec& spec, const PackageFolders& packages,
                                       const std::filesystem::path& urdf, const Place& place);

}  // namespace warmjoint
