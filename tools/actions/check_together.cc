#include "tools/actions/check_together.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "identification/preparation/check_report.h"
#include "tools/terminal/table.h"

namespace warmjoint::inline tools {
namespace {

constexpr double kSameRate = 1.01;
constexpr double kSameSpeed = 5;

/// Those that could be read.
std::vector<const CheckedFile*> Readable(const std::vector<CheckedFile>& files) {
  std::vector<const CheckedFile*> readable;
  for (const CheckedFile& file : files) {
    if (file.check) readable.push_back(&file);
  }
  return readable;
}

using Files = std::vector<const CheckedFile*>;

/// The recordings by a value of theirs, in the order in which values come.
RecordingDifference By(const std::string& what, const Files& files,
                       const std::function<std::string(const CheckedFile&)>& value_of) {
  RecordingDifference difference{what, {}};
  for (const CheckedFile* file : files) {
    // files of the same value stand together
    const std::string value = value_of(*file);
    auto found = std::ranges::find(difference.values, value, &RecordingDifference::Value::value);
    if (found == difference.values.end()) {
      difference.values.push_back({value, {}});
      found = std::prev(difference.values.end());
    }
    found->files.push_back(file->file);
  }
  return difference;
}

double FastestOf(const CheckedFile& file) {
  double fastest = 0;
  for (const SpeedLevel& level : file.check->motion.levels) {
    fastest = std::max(fastest, std::abs(level.velocity));
  }
  return fastest;
}

/// Whether the largest of some figures is more than so many times the smallest; those that are 0 are
/// not known.
bool Spreads(const Files& files, double times,
             const std::function<double(const CheckedFile&)>& figure_of) {
  double least = INFINITY, most = 0;
  for (const CheckedFile* file : files) {
    const double figure = figure_of(*file);
    if (!(figure > 0)) continue;
    least = std::min(least, figure);
    most = std::max(most, figure);
  }
  return most > times * least;
}

/// Whether some travel meets none of the others.
bool PartInTravel(const Files& files) {
  return std::ranges::any_of(files, [&](const CheckedFile* one) {
    const MotionCheck& mine = one->check->motion;
    return files.size() > 1 && std::ranges::none_of(files, [&](const CheckedFile* other) {
             const MotionCheck& theirs = other->check->motion;
             return other != one && mine.lower <= theirs.upper && theirs.lower <= mine.upper;
           });
  });
}

/// Whether a note of the reading says that turns, or ranges, were undone.
std::string WrapOf(const CheckedFile& file) {
  const bool unwrapped = std::ranges::any_of(file.check->notes, [](const std::string& note) {
    return note.find("unwrapped") != std::string::npos;
  });
  return unwrapped ? "position starts again, unwrapped" : "position as it was read";
}

nlohmann::json RowToJson(const CheckedFile& file) {
  nlohmann::json row = file.check
                           ? CheckToJson(*file.check)
                           : nlohmann::json{{"source", file.file}, {"reason", file.unreadable}};
  row["verdict"] = VerdictOf(file);
  return row;
}

}  // namespace

std::vector<std::string> OptionalColumns(const Measurements& as_read) {
  std::vector<std::string> columns;
  const auto add = [&](bool has, const char* name) {
    if (has) columns.emplace_back(name);
  };
  add(as_read.velocity.size() > 0, "velocity");
  add(as_read.motor_position.has_value(), "motor_position");
  add(as_read.load.has_value(), "load");
  add(as_read.temperature.has_value(), "temperature");
  return columns;
}

std::string VerdictOf(const CheckedFile& file) {
  if (!file.check) return "unreadable";
  if (!file.check->faults.empty()) return "faults";
  const bool any = std::ranges::any_of(file.check->excitation, &Excitation::sufficient);
  return any ? "ok" : "no friction";
}

std::vector<RecordingDifference> DifferencesOf(const std::vector<CheckedFile>& files) {
  const Files readable = Readable(files);
  // what has to be the same to the letter
  std::vector<RecordingDifference> differences{
      By("joint", readable,
         [](const CheckedFile& one) {
           return std::string(one.check->joint == JointKind::rotary ? "rotary" : "linear");
         }),
      By("torque in", readable, [](const CheckedFile& one) { return one.check->torque_unit; }),
      By("columns", readable,
         [](const CheckedFile& one) {
           return one.columns.empty() ? std::string("none beyond time, position and torque")
                                      : fmt::format("{}", fmt::join(one.columns, ", "));
         }),
      By("position", readable, WrapOf)};
  // what may differ a little from one recording to the next
  const auto rate = [](const CheckedFile& one) { return one.check->sampling.rate; };
  if (Spreads(readable, kSameRate, rate)) {
    differences.push_back(By("rate", readable, [&](const CheckedFile& one) {
      return fmt::format("{:.4g} Hz", rate(one));
    }));
  }
  if (Spreads(readable, kSameSpeed, FastestOf)) {
    differences.push_back(By("fastest speed", readable, [](const CheckedFile& one) {
      return fmt::format("{:.3g} {}", FastestOf(one), kVelocityUnit.For(one.check->joint));
    }));
  }
  // recordings of different places cannot be compared over position
  if (PartInTravel(readable)) {
    differences.push_back(By("travel", readable, [](const CheckedFile& one) {
      return fmt::format("{:.4g} to {:.4g} {}", one.check->motion.lower, one.check->motion.upper,
                         kPositionUnit.For(one.check->joint));
    }));
  }
  // what all share is no difference
  std::erase_if(differences, [](const RecordingDifference& one) { return one.values.size() < 2; });
  return differences;
}

std::string CheckedTogetherToText(const std::vector<CheckedFile>& files) {
  Table table{
      {"file", "samples", "rate Hz", "duration s", "segments", "speeds +/-", "faults", "verdict"},
      {}};
  for (const CheckedFile& file : files) {
    // a row for each file, with dashes where it cannot be read
    std::vector<std::string>& row = table.rows.emplace_back();
    row = {file.file, "-", "-", "-", "-", "-", "-", VerdictOf(file)};
    if (!file.check) continue;
    const SamplingCheck& sampling = file.check->sampling;
    row[1] = std::to_string(sampling.samples);
    row[2] = fmt::format("{:.4g}", sampling.rate);
    row[3] = fmt::format("{:.4g}", sampling.duration);
    row[4] = std::to_string(file.check->motion.segments);
    // speeds forwards and backwards
    const auto& levels = file.check->motion.levels;
    const auto ahead =
        std::ranges::count_if(levels, [](const SpeedLevel& one) { return one.velocity > 0; });
    row[5] = fmt::format("{}/{}", ahead, levels.size() - static_cast<size_t>(ahead));
    row[6] = std::to_string(file.check->faults.size());
  }
  std::string text = TableToText(table, 1) + "\n";

  // below the table what the recordings do not share
  const std::vector<RecordingDifference> differences = DifferencesOf(files);
  if (differences.empty()) text += "units, columns, wraps and rates are the same in all of them\n";
  for (const RecordingDifference& one : differences) {
    std::vector<std::string> values;
    for (const auto& [value, sharing] : one.values) {
      values.push_back(fmt::format("{} ({})", value, fmt::join(sharing, ", ")));
    }
    text += fmt::format("differs     {}: {}\n", one.what, fmt::join(values, "; "));
  }
  return text;
}

nlohmann::json CheckedTogetherToJson(const std::vector<CheckedFile>& files) {
  nlohmann::json recordings = nlohmann::json::array(), differences = nlohmann::json::array();
  for (const CheckedFile& file : files) recordings.push_back(RowToJson(file));
  for (const RecordingDifference& one : DifferencesOf(files)) {
    nlohmann::json values = nlohmann::json::array();
    for (const auto& [value, sharing] : one.values) {
      values.push_back({{"value", value}, {"files", sharing}});
    }
    differences.push_back({{"what", one.what}, {"values", values}});
  }
  return {{"recordings", recordings}, {"differences", differences}};
}

}  // namespace warmjoint::inline tools
