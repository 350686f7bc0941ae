// warmjoint report SOURCE: a run, or a log with its estimate, on one web page.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "identification/estimate.h"
#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/node.h"
#include "tools/actions/outputs.h"
#include "tools/cli/backend.h"
#include "tools/cli/command.h"
#include "tools/cli/recording_options.h"
#include "tools/cli/typed_options.h"
#include "tools/figures/estimate_view.h"
#include "tools/figures/log_page.h"
#include "tools/figures/run/run_figures.h"
#include "tools/figures/run/run_page.h"
#include "tools/identify/identify_recording.h"
#include "tools/suite/run_realization.h"
#include "tools/terminal/progress_line.h"
#include "tools/terminal/shell_words.h"

namespace warmjoint {
namespace {

namespace fs = std::filesystem;

struct ReportArguments {
  std::string source;
  std::string output;
  RecordingSource recording;
  IdentifySettings settings;
  std::vector<std::string> set;
};

/// What a template shows, and where the page goes.
struct Page {
  fs::path target;
  std::string kind;  // of template
  Tree data;
};

/// Position of the best identifier of the suite that is none from outside; nothing where all are.
std::optional<std::size_t> BestOfOurs(const figures::RunPage& page) {
  // by rank on the board, then by its place in the suite
  for (const LeaderboardRow& best : page.view.board.rows) {
    for (std::size_t i = 0; i < page.suite.identifiers.size(); ++i) {
      const SuiteIdentifier& identifier = page.suite.identifiers[i];
      if (identifier.label == best.identifier && identifier.name != kExternal) return i;
    }
  }
  return std::nullopt;
}

/// Torque and fit of the extremes of that identifier, each simulated and identified once more; or why there
/// are none.
void ReplayExtremes(figures::RunPage& page, Activity& activity) {
  // what the page says where it shows no extremes
  page.without_extremes = "No identifier of warmjoint's own gave numbers that could be shown.";
  const std::optional<std::size_t> best = BestOfOurs(page);
  if (!best) return;
  const figures::RunRow& row = page.view.rows[*best];
  std::vector<figures::ReplayedExtreme> replayed;
  // the extremes are simulated again by their seed, and identified again
  try {
    for (const figures::Extreme& extreme : figures::ExtremesOf(row)) {
      activity.Is(fmt::format("simulating the {} realization again", extreme.rank));
      const Replayed again = ReplayUnit(page.suite, extreme.unit, page.suite.identifiers[*best]);
      replayed.push_back({extreme, NameOf(page.suite, extreme.unit),
                          figures::MakeFitView(again.log, again.estimate)});
    }
  } catch (const BadInput& refusal) {
    // a realization that cannot be repeated is no reason to lose the page
    page.without_extremes = fmt::format("No realization is shown: {}.", refusal.what());
    return;
  }
  if (!replayed.empty()) page.extremes = figures::ExtremesFigure(row.label, replayed);
}

/// Refuses, before time is spent, a page that would be written over what it is made of, or cannot be written.
void ClaimOutput(const fs::path& target, const std::vector<fs::path>& inputs) {
  KeepApart({target}, inputs);
  AtomicFile{target};
}

Page RunReport(const ReportArguments& arguments, Activity& activity) {
  const RunStore store = RunStore::OpenToRead(arguments.source);
  const fs::path beside = fs::path(arguments.source) / "report.html";
  const fs::path target = arguments.output.empty() ? beside : fs::path(arguments.output);
  ClaimOutput(target, {store.results_file(), store.suite_file()});
  NoticeEditedSuite(store);
  // all that the run itself gives
  figures::RunPage page{figures::ReadRunView(store), store.suite(), store.description(), {}};
  for (const figures::RunFigure& figure : figures::RunFigures()) {
    if (auto made = figure.make(page.view)) page.figures.push_back(*std::move(made));
  }
  // then what is simulated again for this page
  ReplayExtremes(page, activity);
  return {target, "run", figures::RunPageData(page)};
}

Tree LogReport(const PreparedLog& log, const Estimate& estimate,
               const std::vector<std::string>& commands) {
  return figures::LogPageData({figures::MakeFitView(log, estimate), CheckRecording(log), commands});
}

bool IsEstimate(const fs::path& source) { return source.extension() == ".json"; }

bool IsRecording(const fs::path& source) {
  return !fs::is_directory(source) && !IsEstimate(source);
}

/// Of a log that is identified here, so that the page can show a void fit, too.
Tree RecordingReport(const ReportArguments& arguments, Activity& activity) {
  const RecordingSource& recording = arguments.recording;
  // identified as `identify` would
  IdentifySettings settings = arguments.settings;
  settings.options = ReadPairs(arguments.set, "--set");
  const IdentifyTask task = CheckSettings(settings, recording.read.joint);
  const PreparedLog log = ReadAndPrepare(recording);
  activity.Aside([&] { TellNotes(log); });
  activity.Is(
      fmt::format("fitting {} to {} samples", task.identifier.name, log.raw().measurements.size()));
  // of a void fit the numbers too
  const Estimate shown = IdentifyLog(task, log, HoldOutSource{}).shown;
  // the command line that makes the same estimate
  std::vector<std::string> words{"warmjoint", "identify"};
  const std::vector<std::string> typed = WordsOf(recording);
  words.insert(words.end(), typed.begin(), typed.end());
  words.insert(words.end(), {"--identifier", task.identifier.name});
  for (const std::string& pair : arguments.set) words.insert(words.end(), {"--set", pair});
  words.insert(words.end(), {"-o", "estimate.json"});
  return LogReport(log, shown, {JoinCommand(words)});
}

/// Of an estimate file, with the recording that it remembers.
Tree EstimateReport(const ReportArguments& arguments) {
  // the estimate, and the recording that it remembers
  const Estimate estimate = ReadEstimate(arguments.source);
  const std::optional<RecordingSource> recording = RecordingOf(estimate, arguments.source);
  if (!recording) {
    Refuse({arguments.source}, "names no recording; give the report the recording itself");
  }
  const PreparedLog log = ReadAndPrepare(*recording);
  // of a refused estimate the fit is made again, so that the page can show it
  return LogReport(
      log, figures::WithFitAgain(estimate, log),
      {JoinCommand({"warmjoint", "report", arguments.source, "-o", arguments.output})});
}

/// Refuses options of a recording beside a run or an estimate, which have their own.
void RefuseOptionsOfRecordings(const CLI::App& parser, const std::string& source) {
  for (const CLI::Option* option : parser.get_options()) {
    const std::string name = option->get_name();
    const bool fits = option->get_positional() || name == "--output" || name == "--quiet" ||
                      name == "--no-project";
    if (fits || option->count() == 0) continue;
    Refuse({name}, "goes with a recording; {} was made with its own, leave the option out", source);
  }
}

ExitStatus Report(const ReportArguments& arguments) {
  Activity activity("reading " + arguments.source);
  // a run by its directory, a log by its file
  if (!fs::exists(arguments.source)) {
    Refuse({arguments.source},
           "is not there; give a directory of `run`, a recording or an estimate file");
  }
  const Backend backend;
  Page page;
  if (fs::is_directory(arguments.source)) {
    page = RunReport(arguments, activity);
  } else {
    // a log has no place of its own for the page
    if (arguments.output.empty()) {
      Refuse({arguments.source}, "is a log: name the page that is to be made, as -o page.html");
    }
    ClaimOutput(arguments.output, {arguments.source});
    page = {arguments.output, "log",
            IsEstimate(arguments.source) ? EstimateReport(arguments)
                                         : RecordingReport(arguments, activity)};
  }

  // the page as a whole, and where it lies
  activity.Is("drawing the page");
  WriteWholeFile(page.target, backend.FillPage(page.kind, page.data));
  activity.Aside([&] { fmt::print(WordsBeside({page.target}), "{}\n", page.target.string()); });
  return ExitStatus::done;
}

}  // namespace

Command AddReportCommand(CLI::App& program) {
  auto arguments = std::make_shared<ReportArguments>();
  CLI::App* parser = program.add_subcommand(
      "report", "One web page that explains a run, or a log and what was identified from it");
  AddValue(*parser, "SOURCE", "SOURCE", arguments->source,
           "directory of `run`, recording, or estimate file (.json) whose recording is there")
      ->required();
  AddValue(*parser, "-o,--output", "FILE", arguments->output,
           "the page; RUN/report.html where it is not given for a run");
  AddValue(*parser, "--identifier", "IDENTIFIER", arguments->settings.identifier, "of a recording")
      ->capture_default_str();
  AddValue(*parser, "--set", "KEY=VALUE", arguments->set,
           "option of the identifier, as law=asymmetric")
      ->take_all();
  AddLayoutOptions(*parser, arguments->recording.read);
  AddHoldOptions(*parser, arguments->recording.prepare);
  return {parser, [arguments, parser] {
            if (IsRecording(arguments->source)) {
              arguments->recording.files = {arguments->source};
              TakeProject(*parser, arguments->recording);
            } else {
              RefuseOptionsOfRecordings(*parser, arguments->source);
            }
            return Report(*arguments);
          }};
}

}  // namespace warmjoint
