// Options of the command line: the first line names an identifier, each other one is a --set, --map, --unit or --scale pair;
// after a first line "project" the rest is a project file, after "recording" the member `recording` of an estimate file.
#include <nlohmann/json.hpp>

#include "identification/identifiers/identifier_list.h"
#include "models/foundation/serialize.h"
#include "models/recording/read_recording.h"
#include "tests/fuzz/fuzz.h"
#include "tools/identify/recording_source.h"
#include "tools/terminal/shell_words.h"

namespace {

using namespace warmjoint;

/// A project file gives what the command line takes.
void ReadProject(std::string_view bytes) {
  const Project project = ParseProject(std::string(bytes), "fuzz.yaml");
  for (const auto& [column, value] : project.map) fuzz::Require(!column.empty());
  fuzz::Require(!project.gear || (std::isfinite(*project.gear) && *project.gear != 0));
  fuzz::Require(!project.wrap || *project.wrap > 0);
  fuzz::Require(!WriteFields(TakenProject{"fuzz.yaml", project}).dump().empty());
}

/// What an estimate file keeps of its recording is read back as it was written.
void ReadKept(std::string_view bytes) {
  const Place place{"fuzz.json"};
  const auto source = ReadAs<RecordingSource>(ParseJsonNode(std::string(bytes), place.file));
  CheckReadSettings(source.read);
  const Tree written = WriteFields(source);
  fuzz::Require(WriteFields(ReadAs<RecordingSource>(Node(written, place.file))) == written);

  // typed for a shell, it is read back word for word
  const std::vector<std::string> words = WordsOf(source);
  fuzz::Require(SplitCommand(JoinCommand(words), place) == words);
}

}  // namespace

void warmjoint::fuzz::Read(std::string_view bytes) {
  const std::string name(fuzz::TakeLine(bytes));
  if (name == "project") return ReadProject(bytes);
  if (name == "recording") return ReadKept(bytes);
  std::vector<std::string> set, map, unit;
  while (!bytes.empty()) {
    std::string_view line = fuzz::TakeLine(bytes);
    auto& pairs = line.starts_with("--map ") ? map : line.starts_with("--unit ") ? unit : set;
    if (&pairs != &set) line.remove_prefix(line.find(' ') + 1);
    pairs.emplace_back(line);
  }

  // how a file is laid out, tried on a small one
  ReadSettings layout;
  for (const auto& [column, theirs] : ReadPairs(map, "--map")) layout.map[column] = theirs;
  for (const auto& [column, text] : ReadPairs(unit, "--unit")) layout.unit[column] = text;
  ParseCsv("time,position,velocity,torque\n0,0,1,1\n1,1,1,2\n2,2,1,1\n", "fuzz.csv", layout);

  // what an identifier is told
  const Identifier& identifier = FindIdentifier(name);
  // what is written is read back
  const auto changed = identifier.options.Read(ReadPairs(set, "--set"), {"--set"}).Changed();
  fuzz::Require(identifier.options.Read(changed, {"again"}).Changed() == changed);
}
