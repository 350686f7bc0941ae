#include "tools/actions/project_file.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "models/foundation/excerpt.h"
#include "models/foundation/nearest_name.h"
#include "models/foundation/serialize.h"
#include "models/recording/recording_columns.h"
#include "scenarios/yaml.h"

namespace warmjoint {
namespace {

/// Entries by which a file could choose what runs.
constexpr std::array<std::string_view, 8> kNoCommands{
    "command", "commands", "identifier", "identifiers", "set", "shell", "allow_commands", "run"};

std::vector<std::string> ColumnNames() {
  std::vector<std::string> names;
  for (const RecordingColumn& column : RecordingColumns()) names.push_back(column.name);
  return names;
}

void RefuseCommands(const Node& document) {
  for (const std::string& key : document.Keys()) {
    if (std::find(kNoCommands.begin(), kNoCommands.end(), key) == kNoCommands.end()) continue;
    const auto value = document.Find(key);
    Refuse(value ? value->place() : document.place(),
           "'{}' does not belong here: a project file describes a log and cannot name what runs; "
           "give it on the command line",
           key);
  }
}

/// A unit that the column can have on some kind of joint.
void CheckUnit(const Node& value, const std::string& name) {
  const auto& columns = RecordingColumns();
  const auto column = std::ranges::find(columns, name, &RecordingColumn::name);
  std::vector<std::string> bases = column->rotary_units;
  bases.insert(bases.end(), column->linear_units.begin(), column->linear_units.end());
  FindUnit(value.Text(), bases, name, value.place());
}

}  // namespace

Project ParseProject(const std::string& text, const std::string& file) {
  const Node document = ParseYaml(text, file);
  // a project says how recordings are read, and nothing else
  if (!document.IsMap()) document.RefuseValue("a map with entries as map, unit, joint, gear");
  RefuseCommands(document);
  const auto project = ReadAs<Project>(document);

  // columns that there are, in units that they can have
  for (const char* key : {"map", "unit", "scale"}) {
    if (const auto columns = document.Find(key)) columns->RequireKnownKeys(ColumnNames());
  }
  for (const auto& [column, unit] : project.unit) {
    if (const auto given = document.Find("unit")->Find(column)) CheckUnit(*given, column);
  }
  return project;
}

}  // namespace warmjoint
