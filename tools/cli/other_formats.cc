#include "tools/cli/other_formats.h"

#include <fmt/format.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/recording/log_formats.h"
#include "models/recording/read_recording.h"
#include "models/robots/robot_folder.h"
#include "tools/cli/python_child.h"

namespace warmjoint {
namespace {

using nlohmann::json;

constexpr unsigned kLongestReading = 10 * 3600;  // s
constexpr const char* kScript = "tools/python/warmjoint/formats/__main__.py";

/// What the child wrote: a line of JSON, and bytes.
struct ConverterAnswer {
  json head;
  std::string_view rest;
};

[[noreturn]] void RefuseBroken(const std::string& file, const std::string& why) {
  Refuse({file}, "cannot be read: {}", why);
}

ConverterAnswer Split(const std::string& file, const std::string& bytes) {
  const std::size_t end = bytes.find('\n');
  json head = json::parse(bytes.substr(0, end), nullptr, false);
  if (end == std::string::npos || !head.is_object()) RefuseBroken(file, "its reader broke off");
  return {std::move(head), std::string_view(bytes).substr(end + 1)};
}

/// The columns behind the head, whose sizes are checked before they are believed.
std::vector<FileColumn> ColumnsOf(const std::string& file, const ConverterAnswer& answer) {
  std::vector<FileColumn> columns;
  std::string_view rest = answer.rest;
  for (const json& one : answer.head.value("columns", json::array())) {
    FileColumn& column = columns.emplace_back(FileColumn{one.at("name"), one.at("unit")});
    const auto count = one.at("count").get<std::size_t>();
    if (count > kMostSamples) {
      Refuse({file}, "{} states {} samples; {} at most are read", Excerpt(column.name), count,
             kMostSamples);
    }
    if (count * sizeof(double) > rest.size()) RefuseBroken(file, "its reader broke off");
    column.values.resize(static_cast<Eigen::Index>(count));
    std::memcpy(column.values.data(), rest.data(), count * sizeof(double));
    rest.remove_prefix(count * sizeof(double));
  }
  return columns;
}

/// Those columns that the map names, by our names.
void TakeMapped(const OtherFormat& asked, FileContent& content) {
  if (asked.map.empty()) return;
  std::vector<std::string> names;
  for (const FileColumn& column : content.columns) names.push_back(column.name);
  std::vector<FileColumn> mapped;
  for (const auto& [ours, theirs] : asked.map) {
    if (theirs.empty()) continue;
    const auto found = std::ranges::find(names, theirs);
    if (found == names.end()) {
      Refuse({asked.file}, "has no column '{}' (for {}){}", Excerpt(theirs), ours,
             Suggestion(theirs, names));
    }
    mapped.push_back(content.columns[static_cast<std::size_t>(found - names.begin())]);
    mapped.back().name = ours;
  }
  content.columns = std::move(mapped);
}

}  // namespace

FileContent ReadOtherFormat(const OtherFormat& asked) {
  std::map<std::string, std::string> readers;
  for (const LogFormat& format : LogFormats()) {
    if (!format.reader.empty()) readers[std::string(format.ending)] = format.reader;
  }
  const json request = {{"file", asked.file},
                        {"readers", readers},
                        {"topic", asked.topic},
                        {"joint", asked.joint},
                        {"joints", "all"},
                        {"map", static_cast<const std::map<std::string, std::string>&>(asked.map)}};
  const std::string script = DataFolder() / kScript;
  Ended ended;
  for (const std::string& python : Pythons()) {
    // by its size a file may take hours, which the script bounds
    ended = CallPython({python, "-B", script, request.dump(-1, ' ', true)}, "",
                       {.seconds = kLongestReading});
    if (ended.ran) break;
  }
  if (!ended.ran) {
    Refuse({asked.file},
           "is read by Python 3, which is not there: sudo apt install python3 python3-numpy");
  }
  if (!ended.well) RefuseBroken(asked.file, "its reader " + ReasonOf(ended));

  const ConverterAnswer answer = Split(asked.file, ended.out);
  if (answer.head.contains("error")) {
    throw BadInput(Printable(answer.head.value("error", std::string())));
  }
  FileContent content;
  const std::vector<std::string> notes = answer.head.value("notes", std::vector<std::string>{});
  if (answer.head.contains("text")) {
    content = ParseTable(answer.rest, asked.file);
    TakeMapped(asked, content);
  } else {
    content.columns = ColumnsOf(asked.file, answer);
  }
  content.notes.insert(content.notes.begin(), notes.begin(), notes.end());
  for (std::string& note : content.notes) note = Printable(note);
  return content;
}

}  // namespace warmjoint
