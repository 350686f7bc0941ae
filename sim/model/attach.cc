#include <warmjoint/attach.h>

#include "models/foundation/atomic_file.h"
#include "models/foundation/excerpt.h"
#include "sim/model/load_model.h"
#include "sim/model/spec_elements.h"

namespace warmjoint {
namespace {

namespace fs = std::filesystem;

/// The folder of a file, also of one that is named without a folder.
fs::path FolderOf(const fs::path& file) {
  return fs::weakly_canonical(fs::absolute(file).parent_path());
}

/// Where assets lie, seen from the folder of the written model.
void PointTo(mjString* directory, const fs::path& from, const fs::path& to) {
  const fs::path absolute = fs::weakly_canonical(from / mjs_getString(directory));
  const fs::path relative = absolute.lexically_relative(to);
  mjs_setString(directory, relative.empty() ? absolute.c_str() : relative.c_str());
}

bool HasFiles(mjSpec& spec) {
  for (const mjtObj type : {mjOBJ_MESH, mjOBJ_HFIELD, mjOBJ_SKIN, mjOBJ_TEXTURE}) {
    if (mjs_firstElement(&spec, type)) return true;
  }
  return false;
}

}  // namespace

Attached AttachFriction(const fs::path& model, const std::vector<FrictionForJoint>& frictions,
                        const fs::path& out, const AttachOptions& options) {
  // the model as it is written
  for (const auto& [name, folder] : options.packages) {
    if (fs::is_directory(folder)) continue;
    Refuse({"--package"}, "of '{}' is '{}', which is not a folder", Excerpt(name),
           Excerpt(folder.string()));
  }
  ParsedModel parsed = ParseModel(model, options.packages);
  mjSpec& spec = *parsed.spec;
  Attached attached = AttachFriction(spec, frictions, options, model.string());
  attached.notices.insert(attached.notices.begin(), parsed.notices.begin(), parsed.notices.end());

  // the result must load from where it will lie
  if (HasFiles(spec)) {
    PointTo(spec.compiler.meshdir, FolderOf(model), FolderOf(out));
    PointTo(spec.compiler.texturedir, FolderOf(model), FolderOf(out));
  }
  AtomicFile file(out);
  file.Write(ModelToXml(spec, {model.string()}));
  LoadModel(file.temporary());
  file.Commit();
  return attached;
}

}  // namespace warmjoint
