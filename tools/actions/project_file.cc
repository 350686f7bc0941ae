#include "tools/actions/project_file.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "models/foundation/excerpt.h"
#include "models/foundation/nearest_name.h"
#include "models/recording/recording_columns.h"
#include "scenarios/yaml_value.h"

namespace warmjoint::inline tools {
namespace {

/// Entries by which a file could choose what runs.
constexpr std::array<std::string_view, 8> kNoCommands{
    "command", "commands", "identifier", "identifiers", "set", "shell", "allow_commands", "run"};

std::vector<std::string> ColumnNames() {
  std::vector<std::string> names;
  for (const RecordingColumn& column : RecordingColumns()) names.push_back(column.name);
  return names;
}

void RefuseCommands(const YamlValue& document) {
  for (const std::string& key : document.Keys()) {
    if (std::find(kNoCommands.begin(), kNoCommands.end(), key) == kNoCommands.end()) continue;
    const auto value = document.Find(key);
    Refuse(value ? value->place() : document.place(),
           "'{}' does not belong here: a project file describes a log and cannot name what runs; "
           "give it on the command line",
           key);
  }
}

/// "column=text" for each entry of a map from columns, checked by `check`.
template <typename Check>
std::vector<std::string> ReadColumns(const YamlValue& map, const Check& check) {
  // a column without a name is left out
  map.RequireKnownKeys(ColumnNames());
  std::vector<std::string> pairs;
  for (const std::string& column : map.Keys()) {
    const auto value = map.Find(column);
    if (value) check(*value, column);
    pairs.push_back(column + "=" + (value ? value->Text() : ""));
  }
  return pairs;
}

/// A unit that the column can have on some kind of joint.
void CheckUnit(const YamlValue& value, const std::string& name) {
  const auto& columns = RecordingColumns();
  const auto column = std::ranges::find(columns, name, &RecordingColumn::name);
  std::vector<std::string> bases = column->rotary_units;
  bases.insert(bases.end(), column->linear_units.begin(), column->linear_units.end());
  FindUnit(value.Text(), bases, name, value.place());
}

std::string ReadJoint(const YamlValue& value) {
  const std::string joint = value.Text();
  const std::vector<std::string> known{"rotary", "linear"};
  if (std::find(known.begin(), known.end(), joint) == known.end()) {
    Refuse(value.place(), "joint is '{}'; it must be rotary or linear{}", Excerpt(joint),
           Suggestion(joint, known));
  }
  return joint;
}

double ReadGear(const YamlValue& value) {
  const double gear = value.Number();
  if (gear == 0) value.RefuseValue("a number other than 0");
  return gear;
}

}  // namespace

Project ParseProject(const std::string& text, const std::string& file) {
  const YamlValue document = YamlValue::Parse(text, file);
  // a project says how recordings are read, and nothing else
  if (!document.IsMap()) document.RefuseValue("a map with entries as map, unit, joint, gear");
  RefuseCommands(document);
  document.RequireKeys({"map", "unit", "scale", "wrap", "joint", "gear", "trim", "shortest_hold"});

  // names of columns, their units and factors
  Project project;
  const auto any = [](const YamlValue&, const std::string&) {};
  const auto number = [](const YamlValue& value, const std::string&) { value.Number(); };
  if (const auto map = document.Find("map")) project.map = ReadColumns(*map, any);
  if (const auto unit = document.Find("unit")) project.unit = ReadColumns(*unit, CheckUnit);
  if (const auto scale = document.Find("scale")) project.scale = ReadColumns(*scale, number);
  // the joint and how its logs are cut
  if (const auto joint = document.Find("joint")) project.joint = ReadJoint(*joint);
  if (const auto gear = document.Find("gear")) project.gear = ReadGear(*gear);
  if (const auto wrap = document.Find("wrap")) project.wrap = wrap->Number(Bound::positive);
  if (const auto trim = document.Find("trim")) project.trim = trim->Number(Bound::not_negative);
  if (const auto hold = document.Find("shortest_hold")) {
    project.shortest_hold = hold->Number(Bound::not_negative);
  }
  return project;
}

nlohmann::json ProjectToJson(const Project& project) {
  nlohmann::json json = nlohmann::json::object();
  // what the project does not say is left out
  const auto list = [&](const char* name, const std::vector<std::string>& pairs) {
    if (!pairs.empty()) json[name] = pairs;
  };
  const auto value = [&](const char* name, const auto& one) {
    if (one) json[name] = *one;
  };
  // members by the names that they have in the file
  list("map", project.map);
  list("unit", project.unit);
  list("scale", project.scale);
  value("joint", project.joint);
  value("gear", project.gear);
  value("wrap", project.wrap);
  value("trim", project.trim);
  value("shortest_hold", project.shortest_hold);
  return json;
}

Project ProjectFromJson(const nlohmann::json& json) {
  Project project;
  // what the file did not say stays empty
  project.map = json.value("map", project.map);
  project.unit = json.value("unit", project.unit);
  project.scale = json.value("scale", project.scale);
  if (json.contains("joint")) project.joint = json["joint"].get<std::string>();
  const auto number = [&](const char* name, std::optional<double>& member) {
    if (json.contains(name)) member = json[name].get<double>();
  };
  number("gear", project.gear);
  number("wrap", project.wrap);
  number("trim", project.trim);
  number("shortest_hold", project.shortest_hold);
  return project;
}

}  // namespace warmjoint::inline tools
