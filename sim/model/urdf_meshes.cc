#include "sim/model/urdf_meshes.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "models/foundation/excerpt.h"
#include "sim/model/spec_elements.h"

namespace warmjoint::inline sim {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPackage = "package://";

std::string NameOf(mjsElement* element) { return mjs_getString(mjs_getName(element)); }

bool MujocoReads(const fs::path& file) {
  std::string extension = file.extension();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension == ".stl" || extension == ".obj" || extension == ".msh";
}

/// Names of the meshes by which something can be touched.
std::set<std::string> TouchedMeshes(mjSpec& spec) {
  std::set<std::string> touched;
  for (mjsElement* element : SpecElements(spec, mjOBJ_GEOM)) {
    const mjsGeom* geom = mjs_asGeom(element);
    if (geom->contype != 0 || geom->conaffinity != 0) touched.insert(mjs_getString(geom->meshname));
  }
  return touched;
}

/// Removes meshes and the shapes that have them.
void Remove(mjSpec& spec, const std::vector<mjsElement*>& meshes) {
  std::set<std::string> names;
  for (mjsElement* mesh : meshes) names.insert(NameOf(mesh));
  for (mjsElement* element : SpecElements(spec, mjOBJ_GEOM)) {
    if (names.contains(mjs_getString(mjs_asGeom(element)->meshname))) mjs_delete(&spec, element);
  }
  for (mjsElement* mesh : meshes) mjs_delete(&spec, mesh);
}

/// Sorts the meshes of one URDF: found, or left out for one of three reasons.
class MeshSorter {
 public:
  MeshSorter(mjSpec& spec, const PackageFolders& packages, const fs::path& urdf, const Place& place)
      : spec_(spec),
        packages_(packages),
        folder_(fs::absolute(urdf).parent_path() / mjs_getString(spec.compiler.meshdir)),
        place_(place),
        touched_(TouchedMeshes(spec)) {}

  void Sort(mjsElement* element) {
    // a mesh without a file has its points in the model
    mjsMesh* mesh = mjs_asMesh(element);
    const std::string file = mjs_getString(mesh->file);
    if (file.empty()) return;
    const std::string name = fs::path(file).filename();

    // packages are folders that only the user knows
    if (file.starts_with(kPackage)) {
      const size_t end = std::min(file.find('/', kPackage.size()), file.size());
      const std::string package = file.substr(kPackage.size(), end - kPackage.size());
      const auto known = packages_.find(package);
      if (known == packages_.end()) {
        packages_lacking_.insert(package);
        return LeaveOut(element, name, lost_);
      }
      PointTo(*mesh, known->second / file.substr(std::min(end + 1, file.size())), package);
    }

    // what MuJoCo cannot read is left out, and what is only seen where its file is lacking
    if (!MujocoReads(file)) return LeaveOut(element, name, foreign_);
    const bool seen_alone = !touched_.contains(NameOf(element));
    if (seen_alone && !fs::exists(folder_ / mjs_getString(mesh->file))) {
      LeaveOut(element, name, absent_);
    }
  }

  std::vector<std::string> Finish() {
    // meshes are deleted after the walk over them
    Remove(spec_, doomed_);
    std::vector<std::string> notices;
    const auto note = [&](const std::set<std::string>& files, const std::string& why) {
      if (files.empty()) return;
      notices.push_back(
          fmt::format("{}: {} meshes {} were left out, and with them what they draw and touch: {}",
                      place_.file, files.size(), why, ExcerptOfList({files.begin(), files.end()})));
    };
    note(lost_, fmt::format("named by package:// (attach finds them with --package {}=FOLDER)",
                            fmt::join(packages_lacking_, "=FOLDER --package ")));
    note(foreign_, "of a format that MuJoCo does not read (it reads stl, obj and msh)");
    note(absent_, "that are only to be seen and have no file");
    return notices;
  }

 private:
  void PointTo(mjsMesh& mesh, const fs::path& file, const std::string& package) {
    const fs::path absolute = fs::weakly_canonical(fs::absolute(file));
    // a file that its package lacks is a folder given wrong
    if (MujocoReads(absolute) && !fs::exists(absolute)) {
      Refuse(place_,
             "package {} is {}, which has no file {}; give its folder by --package {}=FOLDER",
             package, packages_.at(package).string(), absolute.string(), package);
    }
    const fs::path relative = absolute.lexically_relative(fs::weakly_canonical(folder_));
    mjs_setString(mesh.file, relative.empty() ? absolute.c_str() : relative.c_str());
  }

  void LeaveOut(mjsElement* mesh, const std::string& file, std::set<std::string>& reason) {
    doomed_.push_back(mesh);
    reason.insert(file);
  }

  mjSpec& spec_;
  const PackageFolders& packages_;
  fs::path folder_;
  const Place& place_;
  std::set<std::string> touched_;
  std::vector<mjsElement*> doomed_;
  std::set<std::string> lost_, foreign_, absent_, packages_lacking_;
};

}  // namespace

std::string KeepVisuals(std::string urdf) {
  constexpr std::string_view setting = " discardvisual=\"false\"";
  constexpr size_t none = std::string::npos;
  if (urdf.find("discardvisual") != none) return urdf;

  // into the settings that the URDF has for MuJoCo, or into new ones at its end
  const size_t extension = urdf.find("<mujoco");
  const size_t compiler = extension == none ? none : urdf.find("<compiler", extension);
  if (compiler != none)
    return urdf.insert(compiler + std::string_view("<compiler").size(), setting);
  const std::string element = fmt::format("<compiler{}/>", setting);
  const size_t start = extension == none ? none : urdf.find('>', extension);
  if (start != none && urdf[start - 1] != '/') return urdf.insert(start + 1, element);
  const size_t end = urdf.rfind("</robot");
  return end == none ? urdf : urdf.insert(end, fmt::format("<mujoco>{}</mujoco>", element));
}

std::vector<std::string> ResolveMeshes(mjSpec& spec, const PackageFolders& packages,
                                       const fs::path& urdf, const Place& place) {
  MeshSorter sorter(spec, packages, urdf, place);
  for (mjsElement* mesh : SpecElements(spec, mjOBJ_MESH)) sorter.Sort(mesh);
  return sorter.Finish();
}

}  // namespace warmjoint::inline sim
