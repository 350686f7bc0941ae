#include "sim/plugin/attributes.h"

#include <warmjoint/friction.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "models/foundation/excerpt.h"
#include "models/foundation/nearest_name.h"
#include "models/foundation/parse_number.h"
#include "models/friction/check_friction.h"
#include "models/friction/friction_json.h"
#include "models/friction/thermal.h"
#include "sim/plugin/model_folder.h"

namespace warmjoint::inline sim {
namespace {

namespace fs = std::filesystem;

std::string BoundOf(const ParameterInfo& info) {
  // bounds as words, as the table of parameters has them
  if (info.name == Thermal::parameters[0].name) {
    return fmt::format("-{0:g} to {0:g}", kLargestThermalGain);
  }
  if (info.lower == -kInfinity) return "any";
  const bool time = info.name == Thermal::parameters[1].name;
  if (info.lower == kSmallestPositive || time) return "> 0";
  if (info.upper != kInfinity) return fmt::format("{} to {}", info.lower, info.upper);
  return fmt::format(">= {}", info.lower);
}

void AddParameter(const ParameterInfo& info, std::vector<PluginAttribute>& attributes) {
  const auto same_name = [&](const PluginAttribute& known) { return known.name == info.name; };
  if (std::any_of(attributes.begin(), attributes.end(), same_name)) return;
  attributes.push_back({std::string(info.name), std::string(info.unit.rotary), BoundOf(info),
                        std::string(info.meaning)});
}

std::vector<PluginAttribute> MakeAttributes() {
  std::vector<PluginAttribute> attributes{
      {"law", "", fmt::format("{}", fmt::join(LawNames(), ", ")), "the nominal law"},
      {"file", "", "path", "friction file instead of all the other attributes"},
      {"joints", "", "JSON", "friction of each joint by its name, instead of all the others"},
      {"instance", "", "text", "the instance's own name, so that a prefix of the model is known"},
      {"folder", "", "path", "folder from which file starts where it is relative"},
      {"gear", "rad/rad", "not 0", "motor turns for each joint turn; 1 where not given"},
  };

  // the parameters of all laws, each once, then what joins any law
  for (const Law& law : Laws()) {
    for (const ParameterInfo& info : law.parameters) AddParameter(info, attributes);
  }
  for (const ParameterInfo& info : Thermal::parameters) AddParameter(info, attributes);
  for (const ParameterInfo& info : Thermal::parameters) {
    attributes.push_back({fmt::format("{}{}", kSecondStage, info.name),
                          std::string(info.unit.rotary), BoundOf(info),
                          "the same of a second stage"});
  }
  for (const FrictionOption& option : FrictionOptions()) AddParameter(option.info, attributes);
  attributes.push_back({"maps", "", "JSON", "list of maps as in a friction file"});
  attributes.push_back({"initial_energy", "N.m", "any, or JSON",
                        "energy state at a reset: of every joint, or of each by its name"});
  return attributes;
}

double Number(const std::string& name, const std::string& text, const Place& place) {
  const std::optional<double> value = ParseNumber(text);
  if (!value) Refuse(place, "{} is '{}'; it must be a number", name, Excerpt(text));
  return *value;
}

/// Where a relative file lies: in `folder`, in the model's folder where this program loaded it, or
/// in the working directory. MuJoCo does not tell a plugin where its model comes from.
fs::path Locate(const fs::path& file, const fs::path& folder) {
  // a folder that is given goes before the model's, and that before the working directory
  if (file.is_absolute()) return file;
  const fs::path inside = folder / file;
  const fs::path beside = ModelFolder() / inside;
  return !ModelFolder().empty() && fs::exists(beside) ? beside : inside;
}

/// Refuses every attribute that is given beside `whole`, which stands for all of friction.
void RefuseBeside(const std::string& whole, const AttributeReader& read, const Place& place) {
  // what does not describe the friction may stand beside it
  for (const PluginAttribute& attribute : PluginAttributes()) {
    const bool beside = attribute.name == "folder" || attribute.name == "instance" ||
                        attribute.name == "initial_energy";
    if (beside || attribute.name == whole) continue;
    if (read(attribute.name).empty()) continue;
    Refuse(place, "{0} is '{1}' beside {2} '{3}'; give {2} or the other attributes", attribute.name,
           Excerpt(read(attribute.name)), whole, Excerpt(read(whole)));
  }
}

Friction ReadFile(const std::string& file, const AttributeReader& read, const Place& place) {
  RefuseBeside("file", read, place);
  const fs::path path = Locate(file, read("folder"));
  // a file that is not found may be looked for in the wrong folder
  try {
    return ReadFriction(path);
  } catch (const BadInput& refusal) {
    const bool lost = !path.is_absolute() && !fs::exists(path);
    Refuse(place, "file: {}{}", refusal.what(),
           lost ? fmt::format(" (relative to the working directory {}; give folder, or an absolute "
                              "path)",
                              fs::current_path().string())
                : "");
  }
}

/// A gain and a time constant; nothing where neither is given.
std::optional<Thermal> ReadThermal(std::string_view prefix, const AttributeReader& read,
                                   const Place& place) {
  // the two make sense together alone
  const std::string gain_name = fmt::format("{}{}", prefix, kGainName);
  const std::string time_name = fmt::format("{}{}", prefix, kTimeConstantName);
  const std::string gain = read(gain_name), time_constant = read(time_name);
  if (gain.empty() && time_constant.empty()) return std::nullopt;
  if (gain.empty() || time_constant.empty()) {
    Refuse(place, "{} is '{}' and {} '{}'; give both or neither", gain_name, Excerpt(gain),
           time_name, Excerpt(time_constant));
  }
  return Thermal{Number(gain_name, gain, place), Number(time_name, time_constant, place)};
}

std::vector<FrictionMap> ReadMaps(const std::string& text, const Place& place) {
  Tree list = Tree::parse(text, nullptr, false);
  if (!list.is_array()) Refuse(place, "maps must be a JSON list");
  return MapsFrom(Node(Tree{{"maps", std::move(list)}}, place.file).Require("maps", ""));
}

/// The object of joints; of a name given twice JSON would keep the last alone.
nlohmann::json ParseJoints(const std::string& text, const Place& place) {
  using nlohmann::json;

  // refused while it is parsed: afterwards only one of them is left
  std::set<std::string> names;
  const auto refuse_twice = [&](int depth, json::parse_event_t event, json& value) {
    if (event != json::parse_event_t::key || depth != 1) return true;
    const auto name = value.get<std::string>();
    if (!names.insert(name).second) {
      Refuse(place, "joints names '{}' twice; take one out", Excerpt(name));
    }
    return true;
  };
  return json::parse(text, refuse_twice, false);
}

FrictionOfJoints ReadJoints(const AttributeReader& read, const Place& place) {
  using nlohmann::json;
  RefuseBeside("joints", read, place);
  const json object = ParseJoints(read("joints"), place);
  if (!object.is_object() || object.empty()) {
    Refuse(place, "joints must be a JSON object of joint names and their friction");
  }
  // each friction is checked as one of a file is
  FrictionOfJoints joints;
  for (const auto& [name, friction] : object.items()) {
    joints[name] = FrictionFrom({Tree(friction), fmt::format("{}: joints: {}", place.file, name)});
  }
  return joints;
}

Friction ReadInline(const AttributeReader& read, const Place& place) {
  Friction friction;
  if (read("law").empty()) {
    Refuse(place, "law is missing; give one of {}", fmt::join(LawNames(), ", "));
  }
  friction.law = read("law");

  // every parameter that is given, whichever law it belongs to; the check finds those too many
  for (const Law& law : Laws()) {
    for (const ParameterInfo& info : law.parameters) {
      const std::string name(info.name);
      const std::string text = read(name);
      if (!text.empty()) friction.parameters[name] = Number(name, text, place);
    }
  }

  // what joins any law, and what of the table was left out
  friction.thermal = ReadThermal("", read, place);
  friction.second_thermal = ReadThermal(kSecondStage, read, place);
  for (const FrictionOption& option : FrictionOptions()) {
    const std::string name(option.info.name);
    if (!read(name).empty()) friction.*option.value = Number(name, read(name), place);
  }
  if (!read("maps").empty()) friction.maps = ReadMaps(read("maps"), place);
  if (!read("gear").empty()) friction.gear = Number("gear", read("gear"), place);
  FillDefaults(friction);
  CheckFriction(friction, place);
  return friction;
}

}  // namespace

const std::vector<PluginAttribute>& PluginAttributes() {
  static const std::vector<PluginAttribute> attributes = MakeAttributes();
  return attributes;
}

FrictionOfJoints ReadAttributes(const AttributeReader& read, const Place& place) {
  if (!read("joints").empty()) return ReadJoints(read, place);
  const std::string file = read("file");
  return {{"", file.empty() ? ReadInline(read, place) : ReadFile(file, read, place)}};
}

namespace {

/// The energy of a joint at a reset: a number, or one for each stage.
std::array<double, 2> EnergyFrom(const nlohmann::json& value, const Friction& friction,
                                 const Place& place) {
  if (!friction.thermal) {
    Refuse(place, "initial_energy needs thermal, which is not given; give it, or leave it out");
  }
  const auto number = [&](const nlohmann::json& one) {
    return Node({{"initial_energy", Tree(one)}}, place.file)
        .Require("initial_energy", kGiveNumber)
        .Number();
  };
  if (!friction.second_thermal) return {number(value), 0};
  if (!value.is_array() || value.size() != 2) {
    Refuse(place, "initial_energy is {}; with two stages of warming give a list of two numbers",
           Excerpt(value.dump()));
  }
  return {number(value[0]), number(value[1])};
}

}  // namespace

InitialEnergies ReadInitialEnergy(const AttributeReader& read, const FrictionOfJoints& joints,
                                  const Place& place) {
  using nlohmann::json;
  const std::string text = read("initial_energy");
  if (text.empty()) return {};
  // a number for every joint, or a number for each by its name
  const json given = json::parse(text, nullptr, false);
  if (given.is_discarded()) {
    Refuse(place, "initial_energy is '{}'; it must be a number, or JSON by joint", Excerpt(text));
  }
  InitialEnergies energies;
  if (!given.is_object()) {
    for (const auto& [name, friction] : joints) {
      energies[name] = EnergyFrom(given, friction, place);
    }
    return energies;
  }
  for (const auto& [name, value] : given.items()) {
    const auto joint = joints.find(name);
    if (joint == joints.end()) {
      std::vector<std::string> known;
      for (const auto& [other, unused] : joints) known.push_back(other);
      Refuse(place, "initial_energy names '{}', which joints does not{}", Excerpt(name),
             Suggestion(name, known));
    }
    const Place inside{fmt::format("{}: initial_energy: {}", place.file, name)};
    energies[name] = EnergyFrom(value, joint->second, inside);
  }
  return energies;
}

std::string FileStamp(const AttributeReader& read) {
  // path, size and time: a file that changed is read again
  const std::string file = read("file");
  if (file.empty()) return "";
  const fs::path path = Locate(file, read("folder"));
  std::error_code absent;
  const auto size = fs::file_size(path, absent);
  const auto time = fs::last_write_time(path, absent).time_since_epoch().count();
  return fmt::format("{} {} {}", path.string(), size, time);
}

}  // namespace warmjoint::inline sim
