#include "scenarios/suite.h"

#include <warmjoint/suite.h>

#include "models/foundation/excerpt.h"
#include "models/foundation/nearest_name.h"
#include "tools/actions/run_task.h"
#include "tools/board/format_board.h"
#include "tools/interface/guarded.h"
#include "tools/suite/engine.h"

namespace warmjoint::api {
namespace {

void RequireWithin(const std::optional<int>& given, int most, const char* option) {
  // what is not given is within any bounds
  if (!given || (*given >= 1 && *given <= most)) return;
  models::Refuse({option}, "is {}; it must be from 1 to {}", *given, most);
}

tools::RunArguments ToArguments(const std::filesystem::path& suite,
                                const std::filesystem::path& directory,
                                const RunSettings& settings) {
  // numbers have the bounds of the command line
  RequireWithin(settings.jobs, tools::kMostJobs, "--jobs");
  RequireWithin(settings.realizations, scenarios::kMostRealizations, "--realizations");
  tools::RunArguments arguments;
  arguments.suite = suite;
  arguments.output = directory;
  arguments.jobs = settings.jobs;
  arguments.realizations = settings.realizations;
  arguments.seed = settings.seed;
  arguments.identifiers = settings.identifiers;
  arguments.allow_commands = settings.allow_commands;
  if (settings.unconfined) arguments.confinement = tools::Confinement::none;
  arguments.keep = settings.keep_recordings;
  return arguments;
}

Summary FromSummary(const tools::Summary& summary) {
  return {summary.median, summary.q25, summary.q75, summary.rms};
}

LeaderboardRow FromRow(const tools::LeaderboardRow& row) {
  // how often it ran and failed
  LeaderboardRow made;
  made.identifier = row.identifier;
  made.runs = row.runs;
  made.failures = row.failures;

  // how well it does over all realizations
  made.npe_continuous = FromSummary(row.npe_continuous);
  made.npe_discrete = FromSummary(row.npe_discrete);
  made.rmse = FromSummary(row.rmse);
  made.fit = FromSummary(row.fit);
  made.fpe = FromSummary(row.fpe);
  made.mae = FromSummary(row.mae);
  made.seconds = FromSummary(row.seconds);

  // by parameter
  for (const tools::ParameterRow& one : row.parameters) {
    made.parameters.push_back({one.name, one.coverage95, one.efficiency});
  }
  made.not_estimated = row.not_estimated;
  return made;
}

Leaderboard FromBoard(const tools::Leaderboard& board) {
  // of the suite as a whole
  Leaderboard made;
  made.suite = board.suite;
  made.question = board.question;
  made.realizations = board.finished;
  made.bound_npe_continuous = board.bound_npe_continuous;
  made.bound_npe_discrete = board.bound_npe_discrete;

  // one row an identifier, one group a step of the ladder
  for (const tools::LeaderboardRow& row : board.rows) made.rows.push_back(FromRow(row));
  made.variant = board.variant;
  made.value = board.value;
  for (const tools::Leaderboard& group : board.groups) made.groups.push_back(FromBoard(group));
  return made;
}

}  // namespace

RunSummary RunSuite(const std::filesystem::path& suite, const std::filesystem::path& directory,
                    const RunSettings& settings) {
  return Guarded([&] {
    // prepared and stored as by the command, without its words
    const tools::RunTask task = tools::PrepareRun(ToArguments(suite, directory, settings));
    auto store = tools::RunStore::CreateOrResume(directory, task.description);
    const auto quiet = [](int, int) {};

    // progress is told to the caller alone
    tools::RunOptions options{task.jobs, task.shard, settings.keep_recordings, quiet};
    if (settings.watch) options.watch = settings.watch;
    const tools::RunOutcome outcome = tools::RunSuite(task.suite, task.identifiers, options, store);
    tools::RunEnding ending = tools::EndRun(store);
    return RunSummary{outcome.finished, ending.results, ending.failed(), std::move(ending.silent),
                      outcome.following.Words(task.suite)};
  });
}

Leaderboard ReadLeaderboard(const std::filesystem::path& directory) {
  return Guarded(
      [&] { return FromBoard(tools::ReadBoard(tools::RunStore::OpenToRead(directory))); });
}

std::string FormatLeaderboard(const std::filesystem::path& directory, const std::string& format) {
  return Guarded([&]() -> std::string {
    // the formats are those of `compare`
    std::vector<std::string> known;
    for (const tools::BoardFormat& one : tools::BoardFormats()) {
      known.push_back(one.name);
      if (one.name == format) {
        return one.write(tools::ReadBoard(tools::RunStore::OpenToRead(directory)));
      }
    }
    models::Refuse({"--format"}, "is '{}'{}", models::Excerpt(format),
                   models::Suggestion(format, known));
  });
}

}  // namespace warmjoint::api
