#include "tools/suite/external_identifier.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "identification/options.h"
#include "identification/warming/estimated_start.h"
#include "models/foundation/atomic_file.h"
#include "models/foundation/excerpt.h"
#include "models/recording/course_of.h"
#include "models/recording/read_recording.h"
#include "tools/suite/keep_recording.h"
#include "tools/suite/run_command.h"

namespace warmjoint::inline tools {
namespace {

namespace fs = std::filesystem;

const std::vector<OptionInfo>& ExternalOptions() {
  static const std::vector<OptionInfo> options{
      {"command", "", "text", "shell command with {recording} and {estimate}"},
      {"time_limit", "60", "number > 0", "s for each realization"},
  };
  return options;
}

/// A directory of the system's for temporary files, removed at the end of its life.
class WorkingDirectory {
 public:
  WorkingDirectory() {
    std::string pattern = fs::temp_directory_path() / "warmjoint_XXXXXX";
    if (!mkdtemp(pattern.data())) throw std::runtime_error("cannot make " + pattern);
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

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
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

/// The estimate that the command wrote. Members that only our own identifiers have may be left out.
Estimate ReadAnswer(const fs::path& file, const std::string& label) {
  if (!fs::exists(file)) throw NoAnswer("bad_answer", "wrote no estimate");
  try {
    nlohmann::json json = nlohmann::json::parse(ReadWholeFile(file));
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
    throw NoAnswer("bad_answer", error.what());
  } catch (const BadInput& error) {
    throw NoAnswer("bad_answer", error.what());
  }
}

/// The discrete pair (22) of an estimate that brings only the continuous one, without intervals.
void AddDiscretePair(Estimate& estimate, const Measurements& measurements) {
  const EstimatedParameter* gain = estimate.Find("thermal_gain");
  const EstimatedParameter* time_constant = estimate.Find("thermal_time_constant");
  if (!gain || !time_constant || time_constant->value <= 0) return;
  if (estimate.Find("thermal_gain_discrete") || estimate.Find("thermal_pole")) return;

  const Eigen::VectorXd& time = measurements.time;
  const double step = (time[time.size() - 1] - time[0]) / static_cast<double>(time.size() - 1);
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
  Eigen::VectorXd measured(selection.count()), fitted(selection.count());
  for (Eigen::Index i = 0, kept = 0; i < measurements.size(); ++i) {
    if (!selection.keep[i]) continue;
    measured[kept] = measurements.torque[i];
    fitted[kept++] = force[i];
  }
  const auto parameters = static_cast<int>(estimate.parameters.size());
  estimate.metrics = ComputeMetrics(measured, fitted, parameters, parameters);
}

Estimate Ask(const std::string& command, const std::string& label, double limit,
             const Measurements& measurements, const Selection& selection) {
  const WorkingDirectory directory;
  WriteMeasurements(measurements, command, directory.path());
  std::string line = Replaced(command, "{recording}", "recording.csv");
  line = Replaced(line, "{recording.h5}", "recording.h5");
  line = Replaced(line, "{estimate}", "estimate.json");

  const CommandEnd end = RunShellCommand(line, directory.path(), limit);
  if (end.timed_out) throw NoAnswer("timeout", fmt::format("took longer than {} s", limit));
  if (end.status != 0) {
    throw NoAnswer("crashed", fmt::format("exit status {}: {}", end.status, end.last_output));
  }
  Estimate estimate = ReadAnswer(directory.path() / "estimate.json", label);
  AddDiscretePair(estimate, measurements);
  AddMetrics(estimate, measurements, selection);
  return estimate;
}

}  // namespace

bool IsExternal(const std::string& argument) {
  return argument.find('=') != std::string::npos &&
         (Contains(argument, "{recording}") || Contains(argument, "{recording.h5}"));
}

SuiteIdentifier ReadExternal(const std::string& argument) {
  const size_t equals = argument.find('=');
  std::istringstream words(argument.substr(equals + 1));
  std::string command;
  for (std::string word; words >> word;) {
    const bool file = Contains(word, "/") && fs::is_regular_file(word);
    if (!command.empty()) command += ' ';
    command += file ? fs::absolute(word).string() : word;
  }
  if (equals == 0) Refuse({"--identifier"}, "'{}' lacks its name before '='", Excerpt(argument));
  if (!Contains(command, "{estimate}")) {
    Refuse({"--identifier"}, "the command of {} lacks {{estimate}}, the file that it has to write",
           Excerpt(argument.substr(0, equals)));
  }
  return {kExternal, argument.substr(0, equals), {{"command", command}}, {}};
}

PreparedIdentifier PrepareExternal(const SuiteIdentifier& identifier, const Place& place) {
  const Options options(ExternalOptions(), identifier.options, place);
  const std::string command = options.Text("command");
  const double limit = options.Number("time_limit");
  if (!Contains(command, "{estimate}")) {
    Refuse(place, "the command of {} lacks {{estimate}}, the file that it has to write",
           identifier.label);
  }
  return [command, limit, label = identifier.label](const PreparedLog& log, RandomKey) {
    return Ask(command, label, limit, log.taken().measurements, log.taken().selection);
  };
}

}  // namespace warmjoint::inline tools
