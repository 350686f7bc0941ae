// MuJoCo models from MJCF and URDF files, and the meshes of a URDF: where they lie, and which of them MuJoCo can read.
#pragma once

#include <mujoco/mujoco.h>
#include <warmjoint/attach.h>

#include <filesystem>
#include <string>
#include <vector>

#include "models/foundation/bad_input.h"
#include "sim/model/spec_elements.h"

namespace warmjoint {

/// A model as read, open to changes, with what was left out so that it loads.
struct ParsedModel {
  SpecPtr spec;
  std::vector<std::string> notices;  // one sentence each
};

/// Reads an MJCF or URDF file. Of a URDF what is only to be seen is kept, and its meshes are looked
/// for as ResolveMeshes does, those named by `package://` in `packages`. Plugins that MuJoCo comes
/// with are loaded where the model asks for one. Throws BadInput with file and, where MuJoCo tells
/// it, line for an unreadable file and for what ReadDescription refuses, for a name that is no text, and with the link's name
/// for a URDF with a moving link that has no mass.
ParsedModel ParseModel(const std::filesystem::path& path, const PackageFolders& packages = {});

/// Compiles a model. files: meshes and textures that lie in memory. Throws BadInput from `place` with
/// what MuJoCo or a plugin refuses.
ModelPtr CompileModel(mjSpec& spec, const Place& place, const mjVFS* files = nullptr);

/// Throws BadInput, by the name of `target`, for a text of MJCF that does not load from where it will lie.
void RequireLoads(const std::string& xml, const std::filesystem::path& target);

/// A compiled model and the notices of its reading.
struct LoadedModel {
  ModelPtr model;
  std::vector<std::string> notices;
};

/// ParseModel and CompileModel in one.
LoadedModel LoadModel(const std::filesystem::path& path);

/// A spec as MJCF text, as it was written and not as it was compiled (savecompiled and
/// savecanonical off): classes, frames, degrees, Euler angles and actuator shortcuts stay, and every
/// number has the digits that it needs to be read back to the same bits. MuJoCo's other notation
/// rounds to six digits. The text compiles to the model that the spec compiles to, bit for bit.
/// Throws BadInput from `place` where MuJoCo cannot write it.
std::string ModelToXml(mjSpec& spec, const Place& place);

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
