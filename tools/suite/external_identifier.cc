#include "tools/suite/external_identifier.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "identification/answer/judge_estimate.h"
#include "identification/fit_data.h"
#include "identification/options.h"
#include "identification/warming/estimated_start.h"
#include "models/foundation/atomic_file.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/output_failed.h"
#include "models/foundation/read_json.h"
#include "models/foundation/robust_noise.h"
#include "models/recording/course_of.h"
#include "models/recording/read_recording.h"
#include "tools/suite/command_line.h"
#include "tools/suite/keep_recording.h"
#include "tools/suite/run_command.h"

namespace warmjoint::inline tools {
namespace {

namespace fs = std::filesystem;

const std::vector<OptionInfo>& ExternalOptions() {
  static const std::vector<OptionInfo> options{
      {"command", "", "text", "program and arguments with {recording} and {estimate}"},
      {"shell", "no", "no|yes", "whether the command is a line for /bin/sh"},
      {"time_limit", "60", "number > 0 <= 1000000", "s for each realization"},
      {"memory", "4096", "number > 0 <= 1048576", "MiB of each process"},
      {"reads", "", "text", "files and folders that it may read besides its own, parted by :"},
  };
  return options;
}

/// A directory of the system's for temporary files, removed at the end of its life.
class WorkingDirectory {
 public:
  WorkingDirectory() {
    std::string pattern = fs::temp_directory_path() / "warmjoint_XXXXXX";
    if (!mkdtemp(pattern.data())) FailOutput(pattern, errno);
    path_ = pattern;
  }
  ~WorkingDirectory() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  WorkingDirectory(const WorkingDirectory&) = delete;
  WorkingDirectory& operator=(const WorkingDirectory&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

bool Contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

void WriteMeasurements(const Measurements& measurements, const std::string& command,
                       const fs::path& directory) {
  if (Contains(command, "{recording}")) {
    WriteRecording(measurements, directory / "recording.csv");
  }
  if (Contains(command, "{recording.h5}")) {
    WriteHdf5Alone(measurements, directory / "recording.h5");
  }
}

/// The text of the answer. Nothing of the command runs any more, so that what lies there stays.
std::string AnswerText(const fs::path& file) {
  constexpr std::size_t most = std::size_t{16} << 20;  // bytes
  const fs::file_status status = fs::symlink_status(file);
  if (!fs::exists(status)) throw NoAnswer("bad_answer", "wrote no estimate");
  if (!fs::is_regular_file(status)) {
    throw NoAnswer("bad_answer", "the estimate is no regular file");
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
    if (!json.is_object()) throw NoAnswer("bad_answer", "the estimate is no JSON object");
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
  const EstimatedParameter* gain = estimate.Find("thermal_gain");
  const EstimatedParameter* time_constant = estimate.Find("thermal_time_constant");
  if (!gain || !time_constant || time_constant->value <= 0) return;
  if (estimate.Find("thermal_gain_discrete") || estimate.Find("thermal_pole")) return;

  const double step = MedianStep(measurements.time);
  const std::string unit = gain->unit;
  const DiscreteThermal pair = Discretise({gain->value, time_constant->value}, step);
  estimate.parameters.push_back({"thermal_gain_discrete", pair.gain, unit, {}, {}});
  estimate.parameters.push_back({"thermal_pole", pair.pole, "1", {}, {}});
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
};

/// Whether `folder` is, or holds, `path`.
bool IsAround(const fs::path& folder, const fs::path& path) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first ==
         folder.end();
}

/// The folder of an interpreter's own libraries (a virtual environment, a Conda or pyenv one), by
/// its program; empty where there is none, or where it would open what the wall has to hide.
fs::path EnvironmentOf(const fs::path& program) {
  if (program.parent_path().filename() != "bin") return {};
  const fs::path prefix = program.parent_path().parent_path();
  std::error_code ignored;
  const bool known = fs::exists(prefix / "pyvenv.cfg", ignored) ||
                     fs::exists(prefix / "conda-meta", ignored) ||
                     fs::exists(prefix / "lib/python3", ignored);
  return known && !IsAround(prefix, fs::current_path()) ? prefix : fs::path();
}

/// What a command must be able to read: the files that it names, what lies beside the first of them (a
/// script's own modules) unless that is a folder around the current one, and its interpreter's
/// libraries.
std::vector<fs::path> Readable(const std::vector<std::string>& words, const std::string& more) {
  std::vector<fs::path> readable;
  std::error_code ignored;
  for (const std::string& word : words) {
    if (fs::path(word).is_absolute() && fs::is_regular_file(word, ignored)) {
      readable.emplace_back(word);
    }
  }
  if (!readable.empty()) {
    const fs::path beside = readable.front().parent_path();
    if (!IsAround(beside, fs::current_path())) readable.push_back(beside);
  }
  const fs::path program = FindProgram(words.front());
  for (const fs::path& path : {program, fs::weakly_canonical(program, ignored)}) {
    if (!path.is_absolute()) continue;
    readable.push_back(path);
    if (const fs::path libraries = EnvironmentOf(path); !libraries.empty()) {
      readable.push_back(libraries);
    }
  }
  std::istringstream paths(more);
  for (std::string path; std::getline(paths, path, ':');) {
    if (!path.empty()) readable.push_back(fs::absolute(path));
  }
  return readable;
}

/// The command for one directory, its placeholders filled in.
std::vector<std::string> Filled(std::vector<std::string> words) {
  for (std::string& word : words) {
    word = Replaced(word, "{recording}", "recording.csv");
    word = Replaced(word, "{recording.h5}", "recording.h5");
    word = Replaced(word, "{estimate}", "estimate.json");
  }
  return words;
}

Estimate Ask(const Command& command, const PreparedLog& log) {
  const auto& [measurements, selection] = log.taken();
  const WorkingDirectory directory;
  WriteMeasurements(measurements, command.text, directory.path());
  const Wall wall(command.readable, directory.path());
  const CommandEnd end = RunCommand(Filled(command.words), directory.path(), wall, command.limits);
  if (end.timed_out) {
    throw NoAnswer("timeout", fmt::format("took longer than {} s", command.limits.seconds));
  }
  if (end.crowded) {
    throw NoAnswer("crashed", fmt::format("had more than {} processes", command.limits.processes));
  }
  if (end.status != 0) {
    // the directory's name is drawn anew each time; results are not
    const std::string last = Replaced(end.last_output, directory.path(), ".");
    throw NoAnswer("crashed",
                   fmt::format("exit status {}: {}", end.status, Excerpt(last, kLongestComplaint)));
  }
  Estimate estimate = ReadAnswer(directory.path() / "estimate.json", command.label);
  AddDiscretePair(estimate, measurements);
  AddMetrics(estimate, measurements, selection);
  JudgeEstimate(log, {}, estimate);
  return estimate;
}

}  // namespace

bool IsExternal(const std::string& argument) {
  return argument.find('=') != std::string::npos &&
         (Contains(argument, "{recording}") || Contains(argument, "{recording.h5}"));
}

SuiteIdentifier ReadExternal(const std::string& argument, CommandForm form) {
  const size_t equals = argument.find('=');
  const std::string label = argument.substr(0, equals);
  const Place place{"--identifier " + Excerpt(label)};
  if (label.empty()) Refuse({"--identifier"}, "'{}' lacks its name before '='", Excerpt(argument));
  const std::string command = argument.substr(equals + 1);
  if (!Contains(command, "{estimate}")) {
    Refuse(place, "the command lacks {{estimate}}, the file that it has to write");
  }
  SuiteIdentifier identifier{kExternal, label, {}, {}};
  if (form == CommandForm::shell) {
    identifier.options = {{"command", WithAbsoluteFiles(command)}, {"shell", "yes"}};
    return identifier;
  }

  // files are looked for from here, before the command runs elsewhere
  std::vector<std::string> words = SplitCommand(command, place);
  for (std::string& word : words) {
    std::error_code ignored;
    const bool file = Contains(word, "/") && fs::is_regular_file(word, ignored);
    if (file) word = fs::absolute(word);
  }
  identifier.options = {{"command", JoinCommand(words)}};
  return identifier;
}

bool NeedsShell(const SuiteIdentifier& identifier) {
  const auto shell = identifier.options.find("shell");
  return identifier.name == kExternal && shell != identifier.options.end() &&
         shell->second == "yes";
}

std::vector<fs::path> ReadableBy(const SuiteIdentifier& identifier) {
  const Options options(ExternalOptions(), identifier.options, {identifier.label});
  const std::vector<std::string> words =
      SplitCommand(options.Text("command"), {Excerpt(identifier.label)});
  if (words.empty()) Refuse({Excerpt(identifier.label)}, "its command is empty");
  return Readable(words, options.Text("reads"));
}

PreparedIdentifier PrepareExternal(const SuiteIdentifier& identifier, const Place& place) {
  const Options options(ExternalOptions(), identifier.options, place);
  Command command{identifier.label, options.Text("command"), {}, {}, {}};
  if (!Contains(command.text, "{estimate}")) {
    Refuse(place, "the command of {} lacks {{estimate}}, the file that it has to write",
           Excerpt(identifier.label));
  }
  const std::vector<std::string> words = SplitCommand(command.text, place);
  command.readable = ReadableBy(identifier);
  command.words = words;
  if (options.Text("shell") == "yes") command.words = {"/bin/sh", "-c", command.text};
  command.limits.seconds = options.Number("time_limit");
  command.limits.memory =
      static_cast<std::size_t>(options.Number("memory") * static_cast<double>(1 << 20));
  return [command](const PreparedLog& log, StartKey) { return Ask(command, log); };
}

}  // namespace warmjoint::inline tools
