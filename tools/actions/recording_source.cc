#include "tools/actions/recording_source.h"

#include <fmt/format.h>

#include <algorithm>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"

namespace warmjoint {

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
  const auto& [map, unit, scale, wrap, joint, gear, constant] = source.read;
  for (const auto& [column, text] : map) add("--map", column + "=" + text);
  for (const auto& [column, text] : unit) add("--unit", column + "=" + text);
  for (const auto& [column, factor] : scale) add("--scale", fmt::format("{}={}", column, factor));
  // what is as usual needs no words
  const ReadSettings usual;
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
  if (std::ranges::any_of(estimate.recording->files,
                          [](const std::string& one) { return IsStandardInput(one); })) {
    Refuse({file}, "its recording was read from standard input; give it with --recording");
  }
  return estimate.recording;
}

PreparedLog ReadAndPrepare(const RecordingSource& source) {
  return Prepare(ReadRecording(source), source.prepare);
}

}  // namespace warmjoint
