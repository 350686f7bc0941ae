#include "sim/plugin/attributes.h"

#include <fmt/ranges.h>
#include <warmjoint/friction.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "models/foundation/data_folder.h"
#include "models/foundation/excerpt.h"
#include "models/friction/friction_json.h"
#include "models/friction/thermal.h"

namespace warmjoint {
namespace {

namespace fs = std::filesystem;

/// Takes the members of one stage of heat into a list, under a prefix.
struct StageOfHeat {
  std::string_view prefix;
  std::string_view meaning;  // instead of their own, where not empty
  std::vector<NumberAttribute>& numbers;

  template <class T>
  void Field(std::string_view name, T*, FieldInfo info) {
    // a stage may be left out; a gain is bounded by the check of the whole
    info.needed = {};
    if (name == kGainName)
      info.bounds = {.at_least = -kLargestThermalGain, .at_most = kLargestThermalGain};
    if (!meaning.empty()) info.meaning = meaning;
    numbers.push_back({fmt::format("{}{}", prefix, name), info});
  }
};

std::vector<NumberAttribute> ListNumbers() {
  std::vector<NumberAttribute> numbers;
  const auto add = [&](const ParameterInfo& info) {
    const auto known = [&](const NumberAttribute& number) { return number.name == info.name; };
    if (std::ranges::any_of(numbers, known)) return;
    const Bounds bounds{.at_least = info.lower, .at_most = info.upper};
    numbers.push_back({std::string(info.name),
                       {.unit = info.unit.rotary, .bounds = bounds, .meaning = info.meaning}});
  };

  // the parameters of all laws, each once, then what joins any law
  for (const Law& law : Laws()) {
    for (const ParameterInfo& info : law.parameters) add(info);
  }
  StageOfHeat first{"", "", numbers}, second{kSecondStage, "the same of a second stage", numbers};
  Thermal().Serialize(&first);
  Thermal().Serialize(&second);
  for (const FrictionOption& option : FrictionOptions()) add(option.info);
  return numbers;
}

PluginAttributes ReadTexts(const AttributeTexts& texts, const Place& place) {
  const Node node(Tree(texts), place.file, {}, Scalars::texts);
  return ReadAs<PluginAttributes>(node);
}

/// Where a relative file lies: in `folder`, in the model's folder where this program loaded it, or
/// in the working directory.
fs::path Locate(const fs::path& file, const fs::path& folder) {
  // a folder that is given goes before the model's, and that before the working directory
  if (file.is_absolute() || IsOfLibrary(file)) return file;
  const fs::path inside = folder / file;
  const fs::path near_model = ModelFolder() / inside;
  return !ModelFolder().empty() && fs::exists(near_model) ? near_model : inside;
}

/// Refuses every attribute that is given with `whole`, which stands for all of friction.
void RefuseOthers(const std::string& whole, const AttributeTexts& texts, const Place& place) {
  // what does not describe the friction may be given with it
  static const std::set<std::string> others{
      "folder",        "instance",           "initial_energy",
      "joint_sensors", "viscous_as_damping", "stiffest_drive"};
  for (const auto& [name, text] : texts) {
    if (name == whole || others.contains(name)) continue;
    Refuse(place, "{0} is '{1}' beside {2} '{3}'; give {2} or the other attributes", name,
           Excerpt(text), whole, Excerpt(texts.at(whole)));
  }
}

Friction ReadFile(const PluginAttributes& given, const Place& place) {
  const fs::path path = Locate(given.file, given.folder);
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
std::optional<Thermal> ReadThermal(std::string_view prefix, const PluginAttributes& given,
                                   const Place& place) {
  // the two make sense together alone
  const std::string gain_name = fmt::format("{}{}", prefix, kGainName);
  const std::string time_name = fmt::format("{}{}", prefix, kTimeConstantName);
  const auto gain = given.numbers.at(gain_name), time_constant = given.numbers.at(time_name);
  if (gain.has_value() != time_constant.has_value()) {
    Refuse(place, "{} is given without {}; give both or neither", gain ? gain_name : time_name,
           gain ? time_name : gain_name);
  }
  if (!gain) return std::nullopt;
  return Thermal{*gain, *time_constant};
}

Friction ReadInline(const PluginAttributes& given, const Place& place) {
  Friction friction;
  if (given.law.empty()) {
    Refuse(place, "law is missing; give one of {}", fmt::join(LawNames(), ", "));
  }
  friction.law = given.law;

  // every parameter that is given, whichever law it belongs to; the check finds those too many
  for (const Law& law : Laws()) {
    for (const ParameterInfo& info : law.parameters) {
      const std::string name(info.name);
      if (const auto number = given.numbers.at(name)) friction.parameters[name] = *number;
    }
  }

  // what joins any law, and what of the table was left out
  friction.thermal = ReadThermal("", given, place);
  friction.second_thermal = ReadThermal(kSecondStage, given, place);
  for (const FrictionOption& option : FrictionOptions()) {
    const auto number = given.numbers.at(std::string(option.info.name));
    friction.*option.value = number.value_or(0);
  }
  if (!given.maps.is_null()) {
    friction.maps = MapsFrom(Node(Tree{{"maps", given.maps}}, place.file).Require("maps", ""));
  }
  friction.gear = given.gear.value_or(1);
  return Completed(std::move(friction), place);
}

DescribedJoints ReadFriction(const PluginAttributes& given, const AttributeTexts& texts,
                             const Place& place) {
  // one friction for every joint, or a list, each checked as one of a file is
  if (given.joints.is_null() && given.file.empty()) return {{"", {ReadInline(given, place)}}};
  RefuseOthers(given.joints.is_null() ? "file" : "joints", texts, place);
  if (given.joints.is_null()) return {{"", {ReadFile(given, place)}}};
  if (!given.joints.is_object() || given.joints.empty()) {
    Refuse(place, "joints must be a JSON object of joint names and their friction");
  }
  DescribedJoints joints;
  for (const auto& [name, friction] : given.joints.items()) {
    const Node node(friction, fmt::format("{}: joints: {}", place.file, name));
    joints[name].friction = FrictionFrom(node);
  }
  return joints;
}

/// The energy of a joint at a reset: a number, or one for each stage.
std::array<double, 2> ReadEnergy(const Node& node, const Friction& friction) {
  if (!friction.thermal) {
    Refuse(node.place(), "{} needs thermal, which is not given; give it, or leave it out",
           node.key());
  }
  if (!friction.second_thermal) return {node.Number(), 0};
  constexpr std::string_view two = "a list of two numbers, since it warms in two stages";
  const std::vector<Node> stages = node.Entries(two);
  if (stages.size() != 2) node.RefuseValue(two);
  return {stages[0].Number(), stages[1].Number()};
}

void ReadEnergies(const Tree& given, const Place& place, DescribedJoints& joints) {
  if (given.is_null()) return;
  const Node node = Node({{"initial_energy", given}}, place.file).Require("initial_energy", "");
  // for every joint, or for each by its name
  std::vector<std::string> names;
  for (const auto& [name, joint] : joints) names.push_back(name);
  if (node.IsMap()) node.RequireKnownKeys(names);
  for (auto& [name, joint] : joints) {
    const auto own = node.IsMap() ? node.Find(name) : node;
    if (own) joint.initial_energy = ReadEnergy(*own, joint.friction);
  }
}

}  // namespace

const std::vector<NumberAttribute>& NumberAttributes() {
  static const std::vector<NumberAttribute> numbers = ListNumbers();
  return numbers;
}

std::string_view MeaningOfLaw() {
  static const std::string meaning =
      fmt::format("the nominal law: {}", fmt::join(LawNames(), ", "));
  return meaning;
}

const std::vector<std::string>& AttributeNames() {
  static const std::vector<std::string> names = [] {
    FieldNames fields;
    PluginAttributes().Serialize(&fields);
    return fields.names;
  }();
  return names;
}

void ReadValue(const Node& node, Tree* value, const FieldInfo&) {
  // of a name given twice JSON would keep the last alone, so that it is refused while it is parsed
  std::set<std::string> names;
  const auto refuse_twice = [&](int depth, Tree::parse_event_t event, Tree& key) {
    if (event != Tree::parse_event_t::key || depth != 1) return true;
    const auto name = key.get<std::string>();
    if (!names.insert(name).second) {
      Refuse(node.place(), "{} names '{}' twice; take one out", node.key(), Excerpt(name));
    }
    return true;
  };
  *value = Tree::parse(node.Text(), refuse_twice, false);
  if (value->is_discarded() || value->is_null()) node.RefuseValue("JSON");
}

void ReadValue(const Node& node, fs::path* value, const FieldInfo&) { *value = node.Text(); }

InstanceOptions OptionsIn(const AttributeTexts& texts, const Place& place) {
  const PluginAttributes given = ReadTexts(texts, place);
  return {given.joint_sensors, given.viscous_as_damping, given.stiffest_drive};
}

DescribedJoints DescribeJoints(const AttributeTexts& texts, const Place& place) {
  const PluginAttributes given = ReadTexts(texts, place);
  DescribedJoints joints = ReadFriction(given, texts, place);
  ReadEnergies(given.initial_energy, place, joints);
  return joints;
}

std::string FileStamp(const AttributeTexts& texts) {
  // path, size and time: a file that changed is read again
  const auto file = texts.find("file"), folder = texts.find("folder");
  if (file == texts.end()) return "";
  const fs::path path = Locate(file->second, folder == texts.end() ? "" : folder->second);
  std::error_code absent;
  const auto size = fs::file_size(path, absent);
  const auto time = fs::last_write_time(path, absent).time_since_epoch().count();
  return fmt::format("{} {} {}", path.string(), size, time);
}

}  // namespace warmjoint
