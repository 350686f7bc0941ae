// Several recordings beside each other: a row for each, and what differs between them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "identification/preparation/check.h"
#include "models/recording/measurements.h"

namespace warmjoint::inline tools {

/// One recording, or why it could not be read.
struct CheckedFile {
  std::string file;
  std::optional<RecordingCheck> check;
  std::string unreadable;            // the refusal, where there is no check
  std::vector<std::string> columns;  // that it has, of those that need not be there
};

/// The columns that a recording has of those that need not be there. as_read: before its preparation,
/// which makes a velocity where there is none.
std::vector<std::string> OptionalColumns(const Measurements& as_read);

/// In a word: ok; faults; no friction, where its motion shows none; unreadable.
std::string VerdictOf(const CheckedFile& file);

/// One thing in which recordings differ, and the recordings that share each value of it.
struct RecordingDifference {
  struct Value {
    std::string value;
    std::vector<std::string> files;
  };
  std::string what;
  std::vector<Value> values;
};

/// Kind of joint, unit of the torque, columns, turns that were undone, rates (by more than 1 %),
/// fastest speeds (by more than five times) and travels that do not meet, of those that could be read.
std::vector<RecordingDifference> DifferencesOf(const std::vector<CheckedFile>& files);

/// A table of file, samples, rate, duration, segments, speeds, faults and verdict, and a line for each
/// difference.
std::string CheckedTogetherToText(const std::vector<CheckedFile>& files);

/// {recordings[as CheckToJson, and verdict; of an unreadable one source, verdict and reason],
/// differences[{what, values[{value, files[]}]}]}
nlohmann::json CheckedTogetherToJson(const std::vector<CheckedFile>& files);

}  // namespace warmjoint::inline tools
