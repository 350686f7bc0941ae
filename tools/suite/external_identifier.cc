#include "tools/suite/external_identifier.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <span>
#include <sstream>
#include <utility>

#include "identification/answer/check_estimate.h"
#include "identification/estimate.h"
#include "identification/fit/fit_data.h"
#include "identification/fit/fit_parameters.h"
#include "identification/forward/log_trajectory.h"
#include "identification/options.h"
#include "identification/warming/initial_energy.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/node.h"
#include "models/foundation/robust_noise.h"
#include "models/friction/thermal.h"
#include "models/recording/measurements.h"
#include "models/recording/read_recording.h"
#include "tools/suite/run_command.h"
#include "tools/terminal/say.h"
#include "tools/terminal/shell_words.h"

namespace warmjoint {
namespace fs = std::filesystem;
namespace {

constexpr const char* kCsv = "{recording}";
constexpr const char* kHdf5 = "{recording.h5}";
constexpr const char* kEstimate = "{estimate}";

enum class ReadsBeside { no, yes };
std::span<const Word<ReadsBeside>> WordsOf(ReadsBeside) {
  static constexpr std::array words{Word{"no", ReadsBeside::no}, Word{"yes", ReadsBeside::yes}};
  return words;
}

/// The options of a command.
struct ExternalOptions {
  std::string command;     // program and arguments with {recording} and {estimate}
  double time_limit = 60;  // s, of each realization
  double memory = 4096;    // MiB, of each process
  std::string reads;       // files and folders that it may read besides its own, parted by :
  ReadsBeside beside =
      ReadsBeside::yes;  // whether it reads what lies beside the first file it names

  template <class A>
  void Serialize(A* a) {
    a->Field("command", &command);
    a->Field("time_limit", &time_limit, {.unit = "s", .bounds = {.above = 0, .at_most = 1e6}});
    a->Field("memory", &memory, {.unit = "MiB", .bounds = {.above = 0, .at_most = 1 << 20}});
    a->Field("reads", &reads);
    a->Field("beside", &beside);
  }
};

bool Mentions(const std::string& command, const std::string& text) {
  return command.find(text) != std::string::npos;
}

/// The files that a command names.
std::vector<fs::path> FilesOf(const std::vector<std::string>& words) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const std::string& word : words) {
    if (fs::path(word).is_absolute() && fs::is_regular_file(word, ignored)) {
      files.emplace_back(word);
    }
  }
  return files;
}

/// Whether a word of a command names a file, seen from `folder`. The first one is a program: without a folder in it, it is
/// looked for in PATH first, as a shell does.
bool NamesFile(const std::string& word, bool is_program, const fs::path& folder) {
  std::error_code ignored;
  if (word.empty() || !fs::is_regular_file(folder / word, ignored)) return false;
  return !is_program || Mentions(word, "/") || FindProgram(word) == word;
}

/// The entry with the files of its command made absolute, before it runs elsewhere.
SuiteIdentifier WithFilesFrom(const fs::path& folder, SuiteIdentifier identifier,
                              const Place& place) {
  std::string& command = identifier.options.at("command");
  std::vector<std::string> words = SplitCommand(command, place);
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (NamesFile(words[i], i == 0, folder)) words[i] = fs::absolute(folder / words[i]);
  }
  command = JoinCommand(words);
  return identifier;
}

/// A command with its options read.
struct Command {
  std::string label;
  std::string text;
  CommandTask task;  // without the log
  LackOfFitSettings judging;
};

/// The command for a log: its placeholders filled in, and the files that they stand for.
CommandTask TaskFor(const Command& command, const Measurements& measurements) {
  CommandTask task = command.task;
  for (std::string& word : task.arguments) {
    word = Replaced(word, kCsv, "recording.csv");
    word = Replaced(word, kHdf5, "recording.h5");
    word = Replaced(word, kEstimate, task.answer);
  }
  if (Mentions(command.text, kCsv)) {
    task.files.push_back({"recording.csv", RecordingToCsv(measurements)});
  }
  if (Mentions(command.text, kHdf5)) {
    task.files.push_back({"recording.h5", RecordingToHdf5(measurements)});
  }
  return task;
}

/// What helps a command that was kept from starting a program.
std::string RemedyFor(const Command& command, const CommandEnd& end) {
  constexpr int not_executable = 126;  // as shells have it
  if (end.status != not_executable || command.task.confinement == Confinement::none) return "";
  return "; the sandbox kept it from a program: name the interpreter by its full path, or its "
         "folder in the option reads";
}

/// Throws for a command that ended in another way than with an answer.
void RequireAnswer(const Command& command, const CommandEnd& end) {
  const CommandLimits& limits = command.task.limits;
  switch (end.ending) {
    case CommandEnding::timeout:
      throw NoAnswer("timeout", fmt::format("took longer than {} s", limits.seconds));
    case CommandEnding::processes:
      throw NoAnswer("crashed", fmt::format("had more than {} processes", limits.processes));
    case CommandEnding::output:
      throw NoAnswer("crashed", fmt::format("printed more than {} MiB", limits.output >> 20));
    case CommandEnding::by_itself:
      break;
  }
  if (end.status != 0) {
    throw NoAnswer("crashed", fmt::format("exit status {}: {}{}", end.status,
                                          Excerpt(end.last_output, kLongestComplaint),
                                          RemedyFor(command, end)));
  }
  switch (end.kind) {
    case AnswerKind::absent:
      throw NoAnswer("bad_answer", "wrote no estimate");
    case AnswerKind::no_file:
      throw NoAnswer("bad_answer", "the estimate is not a regular file");
    case AnswerKind::too_large:
      throw NoAnswer("bad_answer",
                     fmt::format("the estimate has more than {} MiB", limits.answer >> 20));
    case AnswerKind::whole:
      break;
  }
}

/// The estimate that the command wrote. Members that only our own identifiers have may be left out.
Estimate ReadAnswer(const std::string& text, const std::string& label) {
  try {
    Tree answer = ParseJson(text, "estimate.json");
    if (!answer.is_object()) throw NoAnswer("bad_answer", "the estimate is not a JSON object");
    // members that our own identifiers have and an answer may leave out
    answer.emplace("identifier", label);
    answer.emplace("message", "");
    // what an answer calls these is its own: where a log came from is for who asks to say
    for (const char* asked : {"recording", "project", "follows"}) answer.erase(asked);
    return EstimateFrom({std::move(answer), "estimate.json"});
  } catch (const BadInput& error) {
    throw NoAnswer("bad_answer", Excerpt(error.what(), kLongestComplaint));
  }
}

/// The discrete pair (22) of an estimate that brings only the continuous one, without intervals.
void AddDiscretePair(Estimate& estimate, const Measurements& measurements) {
  const EstimatedParameter* gain = Find(Role::gain, estimate);
  // only where the answer has the continuous pair alone
  const EstimatedParameter* time_constant = Find(Role::time_constant, estimate);
  if (!gain || !time_constant || time_constant->value <= 0) return;
  if (estimate.Find(kDiscreteGainName) || estimate.Find(kPoleName)) return;

  // what the pair is at the step of the samples
  const double step = MedianStep(measurements.time);
  const std::string unit = gain->unit;
  const DiscreteThermal pair = Discretise({gain->value, time_constant->value}, step);
  estimate.parameters.push_back({std::string(kDiscreteGainName), pair.gain, unit, {}, {}});
  estimate.parameters.push_back({std::string(kPoleName), pair.pole, "1", {}, {}});
}

/// Figures of an estimate's friction, started as it says, along a log; none where it has no friction or the selection
/// keeps no sample.
std::optional<Metrics> FrictionMetrics(const Estimate& estimate, const LogSamples& measurements,
                                       const Selection& selection, const ThermalStart& start) {
  if (!estimate.friction || selection.count() == 0) return std::nullopt;
  const Eigen::VectorXd force =
      PredictFriction(*estimate.friction, measurements, start, BristleStart::torque).force;
  const auto parameters = static_cast<int>(estimate.parameters.size());
  return ComputeMetrics(Kept(measurements.torque, selection), Kept(force, selection), parameters,
                        parameters);
}

/// The estimate in an answer, with what our own identifiers tell, too, and judged as they are.
Estimate JudgeAnswer(const std::string& answer, const std::string& label, const PreparedLog& log,
                     const LackOfFitSettings& judging) {
  const auto& [measurements, selection] = log.raw();
  Estimate estimate = ReadAnswer(answer, label);
  AddDiscretePair(estimate, measurements);
  if (!estimate.metrics) {
    estimate.metrics =
        FrictionMetrics(estimate, measurements, selection, StartOf(estimate, measurements));
  }
  CheckEstimate(log, judging, estimate);
  return estimate;
}

Estimate Ask(const Command& command, const PreparedLog& log) {
  const CommandEnd end = RunCommand(TaskFor(command, log.raw().measurements));
  RequireAnswer(command, end);
  return JudgeAnswer(end.answer, command.label, log, command.judging);
}

/// Figures of a second answer, to the part of the log before the held-out share.
std::optional<Metrics> HoldOut(const CheckedCommand& task, const PreparedLog& log,
                               double fraction) {
  const LogView& view = log.raw();
  const Eigen::VectorXd& time = view.measurements.time;
  // the last part of the log's time is held out
  const double begin = time[0], end = time[time.size() - 1];
  const double split = begin + (1 - fraction) * (end - begin);
  const Eigen::Index n = (time.array() < split).count();
  if (fraction == 0 || n < 2) return std::nullopt;

  // later samples test what the command makes of the earlier ones
  Selection test = view.selection;
  test.keep.head(n) = false;
  try {
    const Estimate before = task.ask(log.Before(split), {});
    return FrictionMetrics(before, view.measurements, test, StartOf(before, view.measurements));
  } catch (const NoAnswer&) {
    // part of a log may be too little for it; what it says of all of it stands
    return std::nullopt;
  }
}

}  // namespace

SuiteIdentifier ReadExternal(const std::string& argument) {
  const size_t equals = argument.find('=');
  const std::string label = argument.substr(0, equals);
  const Place place{"--identifier " + Excerpt(label)};
  if (label.empty()) Refuse({"--identifier"}, "'{}' lacks its name before '='", Excerpt(argument));
  // without both files the command has nothing to read or nothing to write
  const std::string command = argument.substr(equals + 1);
  if (!Mentions(command, kEstimate)) {
    Refuse(place, "the command lacks {{estimate}}, the file that it has to write");
  }
  if (!Mentions(command, kCsv) && !Mentions(command, kHdf5)) {
    Refuse(place, "the command lacks {{recording}} or {{recording.h5}}, the file that it gets");
  }
  return WithFilesFrom("", {kExternal, label, {{"command", command}}, {}}, place);
}

SuiteIdentifier WithFilesOfSuite(SuiteIdentifier identifier, const fs::path& suite) {
  if (identifier.name != kExternal || !identifier.options.contains("command")) return identifier;
  const Place place{suite.string()};
  const std::string given = identifier.options.at("command");
  // files of the command are meant from the folder of the suite
  identifier = WithFilesFrom(suite.parent_path(), std::move(identifier), place);
  const std::string& command = identifier.options.at("command");
  // the folder of the suite is not shown: it may hold the truth
  const std::vector<fs::path> files = FilesOf(SplitCommand(command, place));
  if (command == given || files.empty()) return identifier;
  const fs::path beside = files.front().lexically_normal().parent_path();
  if (IsAround(beside, (fs::current_path() / suite).lexically_normal())) {
    identifier.options["beside"] = "no";
  }
  return identifier;
}

std::vector<fs::path> ReadableBy(const SuiteIdentifier& identifier) {
  const auto options = ReadAs<ExternalOptions>(NodeOf(identifier.options, {identifier.label}));
  const Place place{Excerpt(identifier.label)};
  const std::vector<std::string> words = SplitCommand(options.command, place);
  if (words.empty()) Refuse(place, "its command is empty");

  // what it names, and what lies beside a script unless that is around the folder of the run
  std::vector<fs::path> readable = FilesOf(words);
  if (!readable.empty() && options.beside == ReadsBeside::yes) {
    const fs::path beside = readable.front().parent_path();
    if (!IsAround(beside, fs::current_path())) readable.push_back(beside);
  }
  // the program, and the libraries of its environment where it is an interpreter of venv, Conda or pyenv
  const fs::path program = FindProgram(words.front());
  std::error_code ignored;
  for (const fs::path& path : {program, fs::weakly_canonical(program, ignored)}) {
    if (!path.is_absolute()) continue;
    readable.push_back(path);
    if (path.parent_path().filename() != "bin") continue;
    for (const char* part : {"lib", "lib64", "pyvenv.cfg"}) {
      readable.push_back(path.parent_path().parent_path() / part);
    }
  }
  // what the suite allows besides
  std::istringstream paths(options.reads);
  for (std::string path; std::getline(paths, path, ':');) {
    if (!path.empty()) readable.push_back(fs::absolute(path));
  }
  return readable;
}

void ReportConfinement(const std::vector<SuiteIdentifier>& identifiers,
                       const std::vector<fs::path>& secrets, Confinement confinement) {
  const auto is_command = [](const SuiteIdentifier& one) { return one.name == kExternal; };
  if (std::ranges::none_of(identifiers, is_command)) return;
  // that there is no sandbox is a warning, which --quiet keeps
  const std::string words = DescribeSandbox(confinement);
  if (confinement == Confinement::none) return Say(stderr, "{}\n", words);
  SayNotice("{}\n", words);
  for (const SuiteIdentifier& identifier : identifiers) {
    for (const fs::path& secret : secrets) {
      if (!is_command(identifier) || SandboxHides(secret, ReadableBy(identifier))) continue;
      Say(stderr, "warning: {} can read {}, which lies in a folder that it may read; move it\n",
          identifier.label, secret.string());
    }
  }
}

PreparedIdentifier PrepareFunction(const std::string& label, const AnswerFunction& function) {
  return [=](const PreparedLog& log, StartKey) {
    std::string answer;
    try {
      answer = function(log.raw().measurements);
    } catch (const std::exception& failure) {
      throw NoAnswer("crashed", Excerpt(failure.what(), kLongestComplaint));
    }
    return JudgeAnswer(answer, label, log, {});
  };
}

PreparedIdentifier PrepareExternal(const SuiteIdentifier& identifier, const Place& place,
                                   const LackOfFitSettings& judging, Confinement confinement) {
  const auto options = ReadAs<ExternalOptions>(NodeOf(identifier.options, place));
  Command command{identifier.label, options.command, {}, judging};
  // a command that is not told where to write cannot answer
  if (!Mentions(command.text, kEstimate)) {
    Refuse(place, "the command of {} lacks {{estimate}}, the file that it has to write",
           Excerpt(identifier.label));
  }
  if (confinement == Confinement::sandbox && LandlockVersion() == 0) {
    Refuse(place,
           "{} is a command, and this kernel has no Landlock to keep it from your files; where you "
           "trust it, give --unconfined",
           Excerpt(identifier.label));
  }
  // what it may read, how long it may take, and with how much memory
  CommandTask& task = command.task;
  task.readable = ReadableBy(identifier);
  task.arguments = SplitCommand(command.text, place);
  task.answer = "estimate.json";
  task.confinement = confinement;
  task.limits.seconds = options.time_limit;
  task.limits.memory = static_cast<std::size_t>(options.memory * static_cast<double>(1 << 20));
  return [command](const PreparedLog& log, StartKey) { return Ask(command, log); };
}

CheckedCommand CheckCommand(const IdentifySettings& settings, Confinement confinement) {
  // options that mean nothing to a command
  const std::pair<const char*, bool> ours[]{
      {"--gravity", settings.gravity != FittedGravity::none},
      {"--start", settings.start == StartBelief::estimated},
      {"--follows", settings.follows},
      {"--force", settings.void_numbers == VoidNumbers::show}};
  for (const auto& [option, is_given] : ours) {
    if (is_given) Refuse({option}, "is for identifiers of the list; leave it out with a command");
  }
  // what --set gives goes over the command's own options
  SuiteIdentifier command = ReadExternal(settings.identifier);
  for (const auto& [name, value] : settings.options) {
    command.options.insert_or_assign(name, value);
  }
  PreparedIdentifier ask =
      PrepareExternal(command, {"--set"}, LackOfFitSettingsOf(settings), confinement);
  return {std::move(command), std::move(ask)};
}

Estimate IdentifyByCommand(const CheckedCommand& task, const PreparedLog& log,
                           const HoldOutSource& holdout) {
  Estimate estimate = task.ask(log, {});
  MarkAmperes(log.raw().measurements, estimate);
  // held-out figures need samples to test on and an answer to be tested
  if (!holdout.other && holdout.fraction == 0) return estimate;
  if (estimate.status != Status::ok) {
    estimate.without_holdout = fmt::format("the answer is {}", StatusName(estimate.status));
    return estimate;
  }
  // on another recording, or on the last part of this one
  estimate.holdout = holdout.other ? FrictionMetrics(estimate, holdout.other->raw().measurements,
                                                     holdout.other->raw().selection, {})
                                   : HoldOut(task, log, holdout.fraction);
  if (!estimate.holdout) {
    estimate.without_holdout =
        "the command gave no friction for the part before, or the rest keeps no sample";
  }
  return estimate;
}

}  // namespace warmjoint
