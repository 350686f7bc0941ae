#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "models/foundation/excerpt.h"
#include "models/foundation/xml_tags.h"
#include "sim/model/load_model.h"
#include "sim/model/spec_elements.h"

namespace warmjoint {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPackage = "package://";
constexpr std::string_view kFile = "file:";

bool MujocoReads(const fs::path& file) {
  const std::string extension = Lowercase(file.extension().native());
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
    // file:///FOLDER/FILE is the path that begins with the last of its slashes
    if (file.starts_with(kFile)) {
      const size_t begin = file.find_first_not_of('/', kFile.size());
      PointTo(*mesh, "/" + file.substr(std::min(begin, file.size())));
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
  /// package: that the file was looked for in; empty where in none.
  void PointTo(mjsMesh& mesh, const fs::path& file, const std::string& package = "") {
    const fs::path absolute = fs::weakly_canonical(fs::absolute(file));
    // a file that its package lacks is a folder given wrong
    if (!package.empty() && MujocoReads(absolute) && !fs::exists(absolute)) {
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
  const std::string element = fmt::format("<compiler{}/>", setting);
  size_t mujoco = 0;  // where the content of <mujoco> begins, if there is any
  XmlTagReader reader(urdf);
  while (const auto tag = reader.Next()) {
    // into the settings that the URDF has for MuJoCo, or into new ones at its end
    const auto end = static_cast<size_t>(tag->attributes.data() - urdf.data());
    const bool closes = tag->kind == XmlTag::Kind::closes;
    if (tag->name == "compiler") {
      return tag->Attribute("discardvisual") ? urdf : urdf.insert(end, setting);
    }
    if (tag->name == "mujoco" && tag->kind == XmlTag::Kind::opens) {
      mujoco = end + tag->attributes.size() + 1;
    }
    if (tag->name != "robot" || !closes) continue;
    if (mujoco != 0) return urdf.insert(mujoco, element);
    const size_t start = end - std::string_view("</robot").size();
    return urdf.insert(start, fmt::format("<mujoco>{}</mujoco>", element));
  }
  return urdf;
}

std::vector<std::string> ResolveMeshes(mjSpec& spec, const PackageFolders& packages,
                                       const fs::path& urdf, const Place& place) {
  MeshSorter sorter(spec, packages, urdf, place);
  for (mjsElement* mesh : SpecElements(spec, mjOBJ_MESH)) sorter.Sort(mesh);
  return sorter.Finish();
}

}  // namespace warmjoint
