#include "tools/identify/recording_source.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/serialize.h"
#include "models/recording/recording_columns.h"
#include "scenarios/yaml.h"

namespace warmjoint {
namespace {

/// Entries by which a file could choose what runs.
constexpr std::array<std::string_view, 8> kNoCommands{
    "command", "commands", "identifier", "identifiers", "set", "shell", "allow_commands", "run"};

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

std::map<std::string, std::string> ReadPairs(const std::vector<std::string>& pairs,
                                             const std::string& option) {
  std::map<std::string, std::string> map;
  for (const std::string& pair : pairs) {
    // a key before the sign, whatever follows is the value
    const size_t equals = pair.find('=');
    if (equals == std::string::npos || equals == 0) {
      Refuse({option}, "'{}' is not of the form key=value", Excerpt(pair));
    }
    const std::string key = pair.substr(0, equals);
    if (!map.emplace(key, pair.substr(equals + 1)).second) {
      Refuse({option}, "'{}' is given twice; leave one", Excerpt(key));
    }
  }
  return map;
}

std::vector<std::string> WordsOf(const RecordingSource& source) {
  std::vector<std::string> words = source.files;
  const auto add = [&](const char* option, const auto& value) {
    words.insert(words.end(), {option, fmt::format("{}", value)});
  };
  const auto& [map, unit, scale, columns, rate, wrap, joint, gear, constant] = source.read;
  for (const auto& [column, text] : map) add("--map", column + "=" + text);
  for (const auto& [column, text] : unit) add("--unit", column + "=" + text);
  for (const auto& [column, factor] : scale) add("--scale", fmt::format("{}={}", column, factor));
  // what is as usual needs no words
  const ReadSettings usual;
  if (!columns.empty()) add("--columns", fmt::format("{}", fmt::join(columns, ",")));
  if (rate != usual.rate) add("--rate", rate);
  if (wrap != usual.wrap) add("--wrap", wrap);
  if (joint != usual.joint) add("--joint", NameOf(joint));
  if (gear != usual.gear) add("--gear", gear);
  if (constant != usual.torque_constant) add("--torque-constant", constant);
  if (source.prepare.trim != 0) add("--trim", source.prepare.trim);
  if (source.prepare.shortest_hold != 0) add("--shortest-hold", source.prepare.shortest_hold);
  return words;
}

std::optional<RecordingSource> RecordingOf(const Estimate& estimate, const std::string& file) {
  if (!estimate.recording) return std::nullopt;
  if (std::ranges::any_of(estimate.recording->files, IsStandardInput)) {
    Refuse({file}, "its recording was read from standard input; give it with --recording");
  }
  return estimate.recording;
}

PreparedLog ReadAndPrepare(const RecordingSource& source) {
  return Prepare(ReadRecordings(source), source.prepare);
}

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
