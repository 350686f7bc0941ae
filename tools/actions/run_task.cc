#include "tools/actions/run_task.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <thread>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/robots/robot_folder.h"
#include "sim/plant/plant.h"
#include "tools/board/format_board.h"
#include "tools/store/database.h"
#include "tools/suite/external_identifier.h"

namespace warmjoint {
namespace fs = std::filesystem;
namespace {

constexpr const char* kExtension = ".yaml";

fs::path SuiteFolder() { return DataFolder() / "scenarios" / "suites"; }

/// A resumed run takes its own copy of the suite; one with a person's changes is left as it is.
void RefuseEditedCopy(const RunArguments& arguments, const RunDescription& description) {
  const fs::path copy = fs::path(arguments.output) / "suite.yaml";
  std::error_code absent;
  if (!fs::equivalent(arguments.suite, copy, absent)) return;
  if (ReadWholeFile(copy) == description.suite_yaml) return;
  Refuse({arguments.suite},
         "is the run's own copy, which a run writes anew, and holds more than that; name another "
         "file, or another -o");
}

void RequireWithin(std::optional<std::uint64_t> given, std::uint64_t most, const char* option) {
  // what is not given is within any bounds
  if (!given || (*given >= 1 && *given <= most)) return;
  Refuse({option}, "is {}; it must be from 1 to {}", *given, most);
}

/// Refuses more results than a run can keep count of.
void RefuseTooMany(const Suite& suite, const Shard& shard, const Place& place) {
  constexpr double most = 1e8;  // some 10 GB of memory while the run goes on
  const int realizations = shard.End(suite.realizations) - shard.First(suite.realizations);
  const double results = static_cast<double>(realizations) * suite.variants() *
                         static_cast<double>(suite.identifiers.size());
  if (results <= most) return;
  Refuse(place,
         "asks for {:g} results ({} realizations of {} variants by {} identifiers, in {} shards); "
         "{:g} at most: give fewer realizations, or more shards",
         results, suite.realizations, suite.variants(), suite.identifiers.size(), shard.count,
         most);
}

/// Refuses a command that a suite brings along and nobody has agreed to: a suite from elsewhere would be
/// a program.
void RefuseCommand(const SuiteIdentifier& identifier, const RunArguments& arguments) {
  const auto command = identifier.options.find("command");
  if (identifier.name != kExternal || command == identifier.options.end()) return;
  // commands of a suite run only where the user trusts them
  if (arguments.allow_commands) return;
  Refuse({arguments.suite},
         "identifier {} runs the command '{}'; where you trust it, give --allow-commands",
         Excerpt(identifier.label), Excerpt(command->second, kLongestComplaint));
}

/// What an identifier said first.
std::string FirstWords(const RunStore& store, int identifier) {
  return Guarded(store.results_file(), [&] {
    SQLite::Statement first(store.database(),
                            "SELECT status || ': ' || message FROM result WHERE identifier = ? "
                            "ORDER BY variant, realization LIMIT 1");
    first.bind(1, identifier);
    return first.executeStep() ? first.getColumn(0).getString() : "";
  });
}

}  // namespace

std::vector<std::string> SuiteNames() {
  // an installation without suites has none
  std::vector<std::string> names;
  if (!fs::is_directory(SuiteFolder())) return names;
  for (const auto& entry : fs::directory_iterator(SuiteFolder())) {
    if (entry.path().extension() == kExtension) names.push_back(entry.path().stem());
  }
  std::sort(names.begin(), names.end());
  return names;
}

fs::path SuiteFile(const std::string& name) { return SuiteFolder() / (name + kExtension); }

std::string FindSuite(const std::string& name_or_path) {
  // a file goes before a name
  std::error_code unknown;
  const fs::path path = name_or_path;
  if (fs::exists(path, unknown) && !fs::is_directory(path, unknown)) return name_or_path;

  // a name has neither a folder nor an extension
  const std::vector<std::string> names = SuiteNames();
  const bool is_name = !path.has_extension() && !path.has_parent_path();
  if (is_name && std::find(names.begin(), names.end(), name_or_path) != names.end()) {
    return SuiteFile(name_or_path);
  }
  const std::string stem = path.stem();
  Refuse({name_or_path}, "is neither a file nor a shipped suite{}", Suggestion(stem, names));
}

RunTask PrepareRun(RunArguments arguments) {
  arguments.suite = FindSuite(arguments.suite);
  RequireWithin(arguments.jobs, kMostJobs, "--jobs");
  RequireWithin(arguments.realizations, kMostRealizations, "--realizations");
  RunTask task;
  task.suite = ResolveSuite(arguments);
  task.contestants =
      PrepareContestants(task.suite, {arguments.suite}, arguments.confinement, arguments.functions);
  task.shard = ReadShard(arguments.shard);
  // a thread for each core where nothing else is said
  const std::uint64_t cores = std::max(1u, std::thread::hardware_concurrency());
  task.jobs = static_cast<int>(arguments.jobs.value_or(cores));
  RefuseTooMany(task.suite, task.shard, {arguments.suite});
  // a variant that cannot be simulated is found before the run begins
  for (int i = 0; i < task.suite.variants(); ++i) MakePlant(VariantScenario(task.suite, i));

  // what a stored run has to agree with before it goes on
  task.description = Describe(task.suite);
  RefuseEditedCopy(arguments, task.description);
  return task;
}

RunEnding EndRun(RunStore& store) {
  WriteTables(store);
  return EndingOf(store);
}

RunEnding Run(const RunArguments& arguments, const std::function<void(int, int)>& watch) {
  const RunTask task = PrepareRun(arguments);
  RunStore store = RunStore::CreateOrResume(arguments.output, task.description);
  // without a listener nothing is said
  RunOptions options{task.jobs, task.shard, arguments.keep, [](int, int) {}};
  if (watch) options.watch = watch;
  const RunOutcome outcome = RunSuite(task.suite, task.contestants, options, store);
  RunEnding ending = EndRun(store);
  ending.realizations = outcome.finished;
  ending.not_following = outcome.following.Words(task.suite);
  return ending;
}

Suite ResolveSuite(const RunArguments& arguments) {
  Suite suite = ReadSuite(arguments.suite);
  // what the command line says goes over the suite
  if (arguments.realizations) suite.realizations = static_cast<int>(*arguments.realizations);
  if (arguments.seed) suite.scenario.seed = *arguments.seed;
  // commands find their files wherever the run is started from
  for (SuiteIdentifier& identifier : suite.identifiers) {
    identifier = WithFilesOfSuite(std::move(identifier), arguments.suite);
  }
  const std::vector<SuiteIdentifier> own = suite.identifiers;
  suite.identifiers.clear();
  if (!arguments.identifiers.empty() || arguments.functions.empty()) {
    suite.identifiers = ChooseIdentifiers(own, arguments.identifiers, suite.contest);
  }
  for (const SuiteIdentifier& identifier : suite.identifiers) {
    // what the command line itself names was agreed to by naming it
    const bool brought = std::find(own.begin(), own.end(), identifier) != own.end();
    if (brought) RefuseCommand(identifier, arguments);
  }
  if (suite.contest == Contest::compensators && !arguments.functions.empty()) {
    Refuse({"identifiers"}, "are functions, and {} compares compensators", suite.name);
  }
  // functions of the caller stand beside them as commands that cannot be called from a shell
  for (const auto& [label, function] : arguments.functions) {
    const auto same = [&](const SuiteIdentifier& one) { return one.label == label; };
    if (std::ranges::any_of(suite.identifiers, same)) {
      Refuse({"identifiers"}, "there is a '{}' already; give yours another name", Excerpt(label));
    }
    suite.identifiers.push_back({kExternal, label, {{"command", "a function of the caller"}}, {}});
  }
  return suite;
}

RunEnding EndingOf(const RunStore& store) {
  static const std::set<std::string> unanswered{"crashed", "timeout", "bad_answer"};
  RunEnding ending;
  std::set<int> all, answered;
  for (const StatusCount& count : store.CountStatuses()) {
    // no answer, no log to answer on, or an answer that the tests refuse
    const bool silent = unanswered.contains(count.status);
    const bool absent = count.status == "not_simulated";
    ending.results += count.results;
    if (silent) ending.unanswered += count.results;
    if (absent) ending.not_simulated += count.results;
    if (!silent && !absent && count.status != "ok") ending.refused += count.results;
    // a refusal is an answer, silence is none
    all.insert(count.identifier);
    if (!silent && !absent) answered.insert(count.identifier);
  }

  // identifiers that never answered, each with its first reason
  for (std::size_t i = 0; i < store.suite().identifiers.size(); ++i) {
    const auto identifier = static_cast<int>(i);
    if (!all.contains(identifier) || answered.contains(identifier)) continue;
    ending.silent.emplace_back(store.suite().identifiers[i].label, FirstWords(store, identifier));
  }
  return ending;
}

std::string CountsInWords(const RunEnding& ending) {
  std::string words = fmt::format("{} results", ending.results);
  const auto add = [&](std::size_t count, const char* what) {
    if (count > 0) words += fmt::format(", {} {}", count, what);
  };
  add(ending.refused, "rejected by their own tests");
  add(ending.unanswered, "without an answer");
  add(ending.not_simulated, "not simulated");
  return words;
}

}  // namespace warmjoint
