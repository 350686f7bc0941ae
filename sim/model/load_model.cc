#include "sim/model/load_model.h"

#include <fmt/ranges.h>

#include <array>
#include <regex>
#include <set>
#include <string_view>

#include "models/foundation/atomic_file.h"
#include "sim/model/spec_elements.h"
#include "sim/plugin/friction_instance.h"
#include "sim/plugin/model_folder.h"
#include "sim/plugin/register.h"

namespace warmjoint::inline sim {
namespace {

constexpr std::string_view kPackage = "package://";

/// One line of text.
std::string Flatten(std::string_view message) {
  static const std::regex breaks("\\s*\n\\s*");
  const std::string text = std::regex_replace(std::string(message), breaks, "; ");
  const auto last = text.find_last_not_of("; ");
  return last == std::string::npos ? std::string() : text.substr(0, last + 1);
}

/// The line that MuJoCo's message names; 0: none.
int LineOf(const std::string& message) {
  static const std::regex line("[Ll]ine (?:number=)?([0-9]{1,9})");
  std::smatch found;
  return std::regex_search(message, found, line) ? std::stoi(found[1]) : 0;
}

/// The root element of a URDF is <robot>, of an MJCF <mujoco>; the former may hold the latter.
bool IsUrdf(const std::string& text) { return text.find("<robot") < text.find("<mujoco"); }

/// Removes what a URDF's package:// meshes draw and collide. Returns their file names.
std::set<std::string> DropPackageMeshes(mjSpec& spec) {
  std::vector<mjsElement*> doomed;
  std::set<std::string> names, files;
  for (mjsElement* element : SpecElements(spec, mjOBJ_MESH)) {
    const std::string file = mjs_getString(mjs_asMesh(element)->file);
    if (!file.starts_with(kPackage)) continue;
    names.insert(mjs_getString(mjs_getName(element)));
    files.insert(std::filesystem::path(file).filename());
    doomed.push_back(element);
  }
  for (mjsElement* element : SpecElements(spec, mjOBJ_GEOM)) {
    if (names.contains(mjs_getString(mjs_asGeom(element)->meshname))) {
      doomed.insert(doomed.begin(), element);
    }
  }
  for (mjsElement* element : doomed) mjs_delete(&spec, element);
  return files;
}

/// Mass of a body and of all that is fixed to it, kg.
double FixedMass(mjsBody* body) {
  double mass = body->mass;
  for (mjsElement* child = mjs_firstChild(body, mjOBJ_BODY, 0); child;
       child = mjs_nextChild(body, child, 0)) {
    mjsBody* link = mjs_asBody(child);
    if (!mjs_firstChild(link, mjOBJ_JOINT, 0)) mass += FixedMass(link);
  }
  return mass;
}

void CheckInertials(mjSpec& spec, const Place& place) {
  for (mjsElement* element : SpecElements(spec, mjOBJ_BODY)) {
    mjsBody* body = mjs_asBody(element);
    if (!mjs_firstChild(body, mjOBJ_JOINT, 0) || FixedMass(body) > 0) continue;
    Refuse(place,
           "link '{}' moves but neither it nor a link fixed to it has a mass; give it an "
           "<inertial> with mass and inertia",
           mjs_getString(mjs_getName(element)));
  }
}

/// What the plugin refuses, if it does: MuJoCo's message holds it once for each try to bind it.
std::string PluginRefusal(const std::string& message) {
  const std::string mark = std::string(kFrictionPlugin) + ": ";
  const size_t begin = message.find(mark);
  if (begin == std::string::npos) return "";
  return message.substr(begin, message.find("; " + mark, begin) - begin);
}

}  // namespace

ParsedModel ParseModel(const std::filesystem::path& path) {
  RegisterFrictionPlugin();
  const std::string text = ReadWholeFile(path);

  ModelFolder() = std::filesystem::absolute(path).parent_path();
  std::array<char, 2000> error{};
  ParsedModel parsed;
  parsed.spec.reset(mj_parse(path.c_str(), nullptr, nullptr, error.data(), error.size()));
  if (!parsed.spec) {
    const std::string message = Flatten(error.data());
    Refuse({path.string(), LineOf(message)}, "MuJoCo cannot read it: {}", message);
  }

  if (IsUrdf(text)) {
    const std::set<std::string> dropped = DropPackageMeshes(*parsed.spec);
    if (!dropped.empty()) {
      parsed.notices.push_back(fmt::format(
          "{}: {} meshes named by package:// were left out, and with them their contacts: {}",
          path.string(), dropped.size(), fmt::join(dropped, ", ")));
    }
    CheckInertials(*parsed.spec, {path.string()});
  }
  return parsed;
}

ModelPtr CompileModel(mjSpec& spec, const Place& place) {
  ModelPtr model(mj_compile(&spec, nullptr));
  if (model) return model;
  const std::string message = Flatten(mjs_getError(&spec));
  const std::string refusal = PluginRefusal(message);
  if (!refusal.empty()) Refuse(place, "{}", refusal);
  Refuse(place, "MuJoCo cannot compile it: {}", message);
}

LoadedModel LoadModel(const std::filesystem::path& path) {
  ParsedModel parsed = ParseModel(path);
  ModelPtr model = CompileModel(*parsed.spec, {path.string()});
  return {std::move(model), std::move(parsed.notices)};
}

}  // namespace warmjoint::inline sim
