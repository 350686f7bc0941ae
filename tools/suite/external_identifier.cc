#include "tools/suite/external_identifier.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "identification/answer/judge_estimate.h"
#include "identification/estimate_from_json.h"
#include "identification/find_parameter.h"
#include "identification/fit_data.h"
#include "identification/metrics.h"
#include "identification/options.h"
#include "identification/read_options.h"
#include "identification/warming/estimated_start.h"
#include "models/foundation/atomic_file.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/read_json.h"
#include "models/foundation/robust_noise.h"
#include "models/friction/thermal.h"
#include "models/recording/course_of.h"
#include "models/recording/hdf5.h"
#include "models/recording/read_recording.h"
#include "tools/suite/interpreter.h"
#include "tools/suite/run_command.h"
#include "tools/suite/working_directory.h"
#include "tools/terminal/shell_words.h"

namespace warmjoint::inline tools {
namespace {

namespace fs = std::filesystem;

void WriteMeasurements(const Measurements& measurements, const std::string& command,
                       const fs::path& directory) {
  if (Mentions(command, "{recording}")) {
    WriteRecording(measurements, directory / "recording.csv");
  }
  if (Mentions(command, "{recording.h5}")) {
    WriteHdf5(measurements, directory / "recording.h5");
  }
}

/// The text of the answer. Nothing of the command runs any more, so that what lies there stays.
std::string AnswerText(const fs::path& file) {
  constexpr std::size_t most = std::size_t{16} << 20;  // bytes
  const fs::file_status status = fs::symlink_status(file);
  // only a plain file of bounded size is an answer
  if (!fs::exists(status)) throw NoAnswer("bad_answer", "wrote no estimate");
  if (!fs::is_regular_file(status)) {
    throw NoAnswer("bad_answer", "the estimate is not a regular file");
  }
  if (fs::file_size(file) > most) {
    throw NoAnswer("bad_answer", fmt::format("the estimate has more than {} MiB", most >> 20));
  }
  return ReadWholeFile(file, most);
}

/// The estimate that the command wrote. Members that only our own identifiers have may be left out.
Estimate ReadAnswer(const fs::path& file, const std::string& label) {
  const std::string text = AnswerText(file);
  try {
    nlohmann::json json = ParseJson(text, "estimate.json");
    if (!json.is_object()) throw NoAnswer("bad_answer", "the estimate is not a JSON object");
    // members that an answer may leave out
    const nlohmann::json absent{{"identifier", label},
                                {"message", ""},
                                {"metrics", nullptr},
                                {"holdout", nullptr},
                                {"trace", nlohmann::json::array()},
                                {"friction", nullptr}};
    for (const auto& [key, value] : absent.items()) json.emplace(key, value);
    return EstimateFromJson(json, {"estimate.json"});
  } catch (const nlohmann::json::exception& error) {
    throw NoAnswer("bad_answer", Excerpt(error.what(), kLongestComplaint));
  } catch (const BadInput& error) {
    throw NoAnswer("bad_answer", Excerpt(error.what(), kLongestComplaint));
  }
}

/// The discrete pair (22) of an estimate that brings only the continuous one, without intervals.
void AddDiscretePair(Estimate& estimate, const Measurements& measurements) {
  const EstimatedParameter* gain = Find(Role::heat, estimate, 0);
  // only where the answer has the continuous pair alone
  const EstimatedParameter* time_constant = Find(Role::heat, estimate, 1);
  if (!gain || !time_constant || time_constant->value <= 0) return;
  if (estimate.Find(kDiscreteGainName) || estimate.Find(kPoleName)) return;

  // what the pair is at the step of the samples
  const double step = MedianStep(measurements.time);
  const std::string unit = gain->unit;
  const DiscreteThermal pair = Discretise({gain->value, time_constant->value}, step);
  estimate.parameters.push_back({std::string(kDiscreteGainName), pair.gain, unit, {}, {}});
  estimate.parameters.push_back({std::string(kPoleName), pair.pole, "1", {}, {}});
}

/// Figures of an estimate that brings a friction but none of its own.
void AddMetrics(Estimate& estimate, const Measurements& measurements, const Selection& selection) {
  if (estimate.metrics || !estimate.friction || selection.count() == 0) return;
  const Eigen::VectorXd force =
      PredictFriction(*estimate.friction, measurements, StartOf(estimate, measurements),
                      BristleStart::torque)
          .force;
  const auto parameters = static_cast<int>(estimate.parameters.size());
  estimate.metrics = ComputeMetrics(Kept(measurements.torque, selection), Kept(force, selection),
                                    parameters, parameters);
}

/// A command with its options read.
struct Command {
  std::string label;
  std::string text;
  std::vector<std::string> words;  // with placeholders
  std::vector<fs::path> readable;  // besides its own directory
  CommandLimits limits;
  Judging judging;
};

/// The command for one directory, its placeholders filled in.
std::vector<std::string> Filled(std::vector<std::string> words) {
  for (std::string& word : words) {
    word = Replaced(word, "{recording}", "recording.csv");
    word = Replaced(word, "{recording.h5}", "recording.h5");
    word = Replaced(word, "{estimate}", "estimate.json");
  }
  return words;
}

/// What helps a command that found a program and was kept from starting it.
std::string RemedyFor(const CommandEnd& end) {
  constexpr int not_executable = 126;  // as shells have it
  if (end.status != not_executable || BestWall() == WallKind::none) return "";
  return "; the wall kept it from a program: name the interpreter by its full path, or its folder "
         "in the option reads";
}

/// What the command answers of the log. Its directory lives no longer than it does.
Estimate Answer(const Command& command, const Measurements& measurements) {
  // the command works in a directory of its own, behind a wall
  const WorkingDirectory directory;
  WriteMeasurements(measurements, command.text, directory.path());
  const Wall wall(command.readable, directory.path());
  const CommandEnd end = RunCommand(Filled(command.words), directory.path(), wall, command.limits);
  // ends without an answer, each with its reason
  if (end.timed_out) {
    throw NoAnswer("timeout", fmt::format("took longer than {} s", command.limits.seconds));
  }
  if (end.crowded) {
    throw NoAnswer("crashed", fmt::format("had more than {} processes", command.limits.processes));
  }
  if (end.status != 0) {
    // the directory's name is drawn anew each time; results are not
    const std::string last = Replaced(end.last_output, directory.path(), ".");
    throw NoAnswer("crashed", fmt::format("exit status {}: {}{}", end.status,
                                          Excerpt(last, kLongestComplaint), RemedyFor(end)));
  }
  return ReadAnswer(directory.path() / "estimate.json", command.label);
}

Estimate Ask(const Command& command, const PreparedLog& log) {
  const auto& [measurements, selection] = log.taken();
  Estimate estimate = Answer(command, measurements);
  AddDiscretePair(estimate, measurements);
  AddMetrics(estimate, measurements, selection);
  JudgeEstimate(log, command.judging, estimate);
  return estimate;
}

}  // namespace

PreparedIdentifier PrepareExternal(const SuiteIdentifier& identifier, const Place& place,
                                   const Judging& judging) {
  const Options options = ReadOptions(ExternalOptions(), identifier.options, place);
  Command command{identifier.label, options.Text("command"), {}, {}, {}, judging};
  // a command that is not told where to write cannot answer
  if (!Mentions(command.text, "{estimate}")) {
    Refuse(place, "the command of {} lacks {{estimate}}, the file that it has to write",
           Excerpt(identifier.label));
  }
  // its words, or a line for a shell where the suite asks for one
  const std::vector<std::string> words = SplitCommand(command.text, place);
  command.readable = ReadableBy(identifier);
  command.words = words;
  command.words.front() = FindInterpreter(words.front());
  if (options.Text("shell") == "yes") command.words = {"/bin/sh", "-c", command.text};
  // how long it may take, and with how much memory
  command.limits.seconds = options.Number("time_limit");
  command.limits.memory =
      static_cast<std::size_t>(options.Number("memory") * static_cast<double>(1 << 20));
  return [command](const PreparedLog& log, StartKey) { return Ask(command, log); };
}

}  // namespace warmjoint::inline tools
