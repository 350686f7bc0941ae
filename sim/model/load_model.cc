#include "sim/model/load_model.h"

#include <dlfcn.h>
#include <mujoco/mujoco.h>

#include <array>
#include <filesystem>
#include <regex>
#include <string_view>
#include <utility>

#include "models/foundation/description_text.h"
#include "models/foundation/names.h"
#include "models/foundation/xml_tags.h"
#include "sim/model/spec_elements.h"
#include "sim/plugin/attributes.h"
#include "sim/plugin/register.h"

namespace warmjoint {
namespace {

namespace fs = std::filesystem;

/// The folder of MuJoCo's library; empty where the system does not tell.
fs::path MujocoFolder() {
  Dl_info library{};
  if (dladdr(reinterpret_cast<void*>(&mj_version), &library) == 0) return {};
  return fs::absolute(library.dli_fname).parent_path();
}

/// Loads, the first time that it is called, the plugin libraries that MuJoCo itself comes with: those in
/// the folder `plugin` (wheel) or `mujoco_plugin` (release archive) beside its library or in ../bin. No
/// other folder is looked at: loading a library runs it. Returns whether this call loaded any.
bool LoadMujocoPlugins() {
  // once in a process: a second time each would be registered twice
  static bool loaded = false;
  if (std::exchange(loaded, true)) return false;
  const fs::path library = MujocoFolder();
  if (library.empty()) return false;
  // folders in which its packages have them
  bool any = false;
  for (const char* folder : {"plugin", "mujoco_plugin", "../bin/mujoco_plugin"}) {
    std::error_code absent;
    if (!fs::is_directory(library / folder, absent)) continue;
    mj_loadAllPluginLibraries((library / folder).c_str(), nullptr);
    any = true;
  }
  return any;
}

/// The plugin that a message of MuJoCo calls unknown; empty where it complains of something else.
std::string UnknownPlugin(const std::string& message) {
  static const std::regex complaint(
      "[Pp]lugin '?([A-Za-z0-9_.:/-]+)'? not found|"
      "unknown plugin '?([A-Za-z0-9_.:/-]+)'?");
  std::smatch found;
  if (!std::regex_search(message, found, complaint)) return "";
  return found[1].matched ? found[1] : found[2];
}

constexpr double kLargestTexture = 1 << 30;  // bytes

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
/// Refuses descriptions of robots in formats that are neither MJCF nor URDF.
void RefuseOtherFormats(const std::string& text, const std::filesystem::path& path) {
  const auto root = XmlTagReader(text).Next();
  const bool usd = text.starts_with("#usda") || text.starts_with("PXR-USDC");
  const bool sdf = root && root->name == "sdf";
  if (!usd && !sdf) return;
  Refuse({path.string()}, "is {}; attach reads MJCF and URDF: write the robot as one of these",
         usd ? "USD" : "SDF");
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

/// Refuses names that are no text: they go into tables, pages, pictures and programs.
void RequireNames(mjSpec& spec, const Place& place) {
  for (const mjtObj kind :
       {mjOBJ_BODY, mjOBJ_JOINT, mjOBJ_GEOM, mjOBJ_SITE, mjOBJ_MESH, mjOBJ_HFIELD, mjOBJ_TEXTURE,
        mjOBJ_MATERIAL, mjOBJ_TENDON, mjOBJ_ACTUATOR, mjOBJ_SENSOR, mjOBJ_KEY}) {
    const std::string what = fmt::format("the name of a {}", mju_type2Str(kind));
    for (mjsElement* element : SpecElements(spec, kind)) RequireName(what, NameOf(element), place);
  }
}

void CheckInertials(mjSpec& spec, const Place& place) {
  // a smallest mass and inertia of all bodies, as <compiler> may ask for
  if (spec.compiler.boundmass > 0 && spec.compiler.boundinertia > 0) return;
  // a body with a joint, and all that is fixed to it, must have a mass
  for (mjsElement* element : SpecElements(spec, mjOBJ_BODY)) {
    mjsBody* body = mjs_asBody(element);
    if (!mjs_firstChild(body, mjOBJ_JOINT, 0) || FixedMass(body) > 0) continue;
    Refuse(place,
           "link '{}' moves but neither it nor a link fixed to it has a mass; give it an "
           "<inertial> with mass and inertia, or all links a least one by "
           "<mujoco><compiler boundmass=\"0.01\" boundinertia=\"0.0001\"/></mujoco> in <robot>",
           NameOf(element));
  }
}

SpecPtr ParseMjcf(const std::filesystem::path& path, std::string& message) {
  std::array<char, 2000> error{};
  SpecPtr spec(mj_parse(path.c_str(), nullptr, nullptr, error.data(), error.size()));
  message = Flatten(error.data());
  return spec;
}

/// A URDF with what is only to be seen; its files count from ModelFolder.
SpecPtr ParseUrdf(const std::string& text, std::string& message) {
  std::array<char, 2000> error{};
  SpecPtr spec(mj_parseXMLString(KeepVisuals(text).c_str(), nullptr, error.data(), error.size()));
  message = Flatten(error.data());
  if (spec) mjs_setString(spec->modelfiledir, (ModelFolder() / "").c_str());
  return spec;
}

[[noreturn]] void RefuseUnread(const std::filesystem::path& path, const std::string& message) {
  // a plugin that MuJoCo lacks has a remedy of its own
  const Place place{path.string(), LineOf(message)};
  const std::string plugin = UnknownPlugin(message);
  if (plugin.empty()) Refuse(place, "MuJoCo cannot read it: {}", message);
  Refuse(place,
         "it asks for the plugin '{}', which is neither ours nor one of those that come with "
         "MuJoCo; take its elements out of a copy of the model, and put them back into the result",
         plugin);
}

/// What the plugin refuses, if it does: MuJoCo's message holds it once for each try to bind it.
std::string PluginRefusal(const std::string& message) {
  const std::string mark = std::string(kFrictionPlugin) + ": ";
  const size_t begin = message.find(mark);
  if (begin == std::string::npos) return "";
  return message.substr(begin, message.find("; " + mark, begin) - begin);
}

/// Refuses masses and inertias of which no torque can be computed.
void RequireWeights(const mjModel& model, const Place& place) {
  constexpr double most = 1e12;  // kg, kg.m^2; why: more than any robot has, and squares are exact
  for (int body = 1; body < model.nbody; ++body) {
    const double* const inertia = model.body_inertia + 3 * body;
    const double worst = std::max({model.body_mass[body], inertia[0], inertia[1], inertia[2]});
    if (worst <= most) continue;
    const char* const name = mj_id2name(&model, mjOBJ_BODY, body);
    Refuse(place, "link '{}' has a mass or inertia of {:g} kg or kg.m^2; at most {:g}",
           name ? name : "", worst, most);
  }
}

/// Refuses texts of the model that XML has no characters for: MuJoCo writes them as they are.
void RequireXml(std::string_view text, const Place& place) {
  for (int line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    RequireText(fmt::format("line {} of the model as MJCF,", line), text.substr(0, end), place);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

}  // namespace

ParsedModel ParseModel(const std::filesystem::path& path, const PackageFolders& packages) {
  // the plugin is known before a model asks for it
  RegisterFrictionPlugin();
  // what MuJoCo would wait for, or never end with, is refused before it sees the model
  const std::string text = ReadDescription(path, packages).text;
  RefuseOtherFormats(text, path);
  const bool urdf = IsUrdf(text);
  ModelFolder() = std::filesystem::absolute(path).parent_path();

  // plugins of MuJoCo's own are loaded where the model asks for one
  std::string error;
  const auto parse = [&] { return urdf ? ParseUrdf(text, error) : ParseMjcf(path, error); };
  ParsedModel parsed{parse(), {}};
  if (!parsed.spec && !UnknownPlugin(error).empty() && LoadMujocoPlugins()) parsed.spec = parse();
  if (!parsed.spec) RefuseUnread(path, error);

  const Place place{path.string()};
  RequireNames(*parsed.spec, place);
  if (urdf) {
    parsed.notices = ResolveMeshes(*parsed.spec, packages, path, place);
    CheckInertials(*parsed.spec, place);
  }
  return parsed;
}

ModelPtr CompileModel(mjSpec& spec, const Place& place, const mjVFS* files) {
  // textures that the compiler makes, three bytes a pixel
  for (mjsElement* element : SpecElements(spec, mjOBJ_TEXTURE)) {
    const mjsTexture* texture = mjs_asTexture(element);
    const double bytes = 3.0 * texture->width * texture->height;
    if (bytes <= kLargestTexture) continue;
    Refuse(place, "width and height of a <texture> make {:.1f} GiB; 1 GiB at most",
           bytes / kLargestTexture);
  }
  ModelPtr model(mj_compile(&spec, files));
  if (model) {
    RequireWeights(*model, place);
    return model;
  }
  // what our plugin refused says more than MuJoCo's message around it
  const std::string message = Flatten(mjs_getError(&spec));
  const std::string refusal = PluginRefusal(message);
  if (!refusal.empty()) Refuse(place, "{}", refusal);
  const bool inertia = message.find("inertia must") != std::string::npos;
  Refuse(place, "MuJoCo cannot compile it: {}{}", message,
         inertia
             ? "; <compiler balanceinertia=\"true\" boundmass=\"0.01\" boundinertia=\"0.0001\"/> "
               "in <mujoco>, which a URDF may hold in <robot>, makes inertias valid"
             : "");
}

void RequireLoads(const std::string& xml, const fs::path& target) {
  std::array<char, 2000> error{};
  const SpecPtr spec(mj_parseXMLString(xml.c_str(), nullptr, error.data(), error.size()));
  if (!spec) RefuseUnread(target, Flatten(error.data()));
  // its files, and the plugin's, count from the folder that it will lie in
  ModelFolder() = fs::absolute(target).parent_path();
  mjs_setString(spec->modelfiledir, (ModelFolder() / "").c_str());
  CompileModel(*spec, {target.string()});
}

LoadedModel LoadModel(const std::filesystem::path& path) {
  ParsedModel parsed = ParseModel(path);
  ModelPtr model = CompileModel(*parsed.spec, {path.string()});
  return {std::move(model), std::move(parsed.notices)};
}

std::string ModelToXml(mjSpec& spec, const Place& place) {
#if mjVERSION_HEADER >= 3017000
  // as it was written, not as the compiler changed it; earlier engines write what they compiled alone
  spec.compiler.savecompiled = 0;
  spec.compiler.savecanonical = 0;
#endif

  // the first call tells how much room the second needs
  std::array<char, 1000> error{};
  std::string text(1, '\0');
  const int size = mj_saveXMLString(&spec, text.data(), 1, error.data(), error.size());
  if (size >= 0) {
    text.resize(static_cast<size_t>(size) + 1);
    if (mj_saveXMLString(&spec, text.data(), size + 1, error.data(), error.size()) == 0) {
      text.resize(text.find('\0'));
      RequireXml(text, place);
      return text;
    }
  }
  Refuse(place, "MuJoCo cannot write it as MJCF: {}", error.data());
}

}  // namespace warmjoint
