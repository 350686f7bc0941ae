// warmjoint report SOURCE: a run, a log with its estimate, or a robot's answer on one web page.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "identification/estimate.h"
#include "identification/robot/robot_estimate.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/node.h"
#include "models/foundation/serialize.h"
#include "tools/actions/outputs.h"
#include "tools/cli/backend.h"
#include "tools/cli/command.h"
#include "tools/cli/recording_options.h"
#include "tools/cli/typed_options.h"
#include "tools/identify/identify_recording.h"
#include "tools/shown/estimate_data.h"
#include "tools/shown/run/run_data.h"
#include "tools/terminal/progress_line.h"
#include "tools/terminal/say.h"
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
struct ReportPage {
  Outputs output;  // one page
  fs::path target;
  std::string kind;  // of template
  shown::ShownData data;
  std::shared_ptr<RunStore> store{};  // of a run, whose database is read until the page is filled
};

ReportPage RunReport(const ReportArguments& arguments, Activity& activity) {
  const auto store = std::make_shared<RunStore>(RunStore::OpenToRead(arguments.source));
  const fs::path beside = fs::path(arguments.source) / "report.html";
  const fs::path target = arguments.output.empty() ? beside : fs::path(arguments.output);
  Outputs output({target}, {store->results_file(), store->suite_file()});
  NoticeEditedSuite(*store);
  ReportPage page{std::move(output), target, "run", {}};
  page.data.facts =
      shown::RunPageFacts(*store, page.data, [&](const std::string& words) { activity.Is(words); });
  page.store = store;
  return page;
}

shown::ShownData LogReport(const PreparedLog& log, const Estimate& estimate,
                           const std::vector<std::string>& commands) {
  shown::ShownData data;
  data.facts =
      shown::PageFacts(shown::MakeFitView(log, estimate), CheckRecording(log), commands, data);
  return data;
}

bool IsEstimate(const fs::path& source) { return source.extension() == ".json"; }

bool IsRecording(const fs::path& source) {
  return !fs::is_directory(source) && !IsEstimate(source);
}

/// Of a log that is identified here, so that the page can show a void fit, too.
shown::ShownData RecordingReport(const ReportArguments& arguments, Activity& activity) {
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
  const Estimate shown = Identify(task, log, {HoldOutSource{}}).shown;
  // the command line that makes the same estimate
  std::vector<std::string> words{"warmjoint", "identify"};
  const std::vector<std::string> typed = WordsOf(recording);
  words.insert(words.end(), typed.begin(), typed.end());
  words.insert(words.end(), {"--identifier", task.identifier.name});
  for (const std::string& pair : arguments.set) words.insert(words.end(), {"--set", pair});
  words.insert(words.end(), {"-o", "estimate.json"});
  return LogReport(log, shown, {JoinCommand(words)});
}

/// Of an estimate file, with the recording that it remembers, which must not be written over.
shown::ShownData EstimateReport(const ReportArguments& arguments, Outputs& output) {
  // the estimate, and the recording that it remembers
  const Estimate estimate = ReadEstimate(arguments.source);
  const std::optional<RecordingSource> recording = RecordingOf(estimate, arguments.source);
  if (!recording) {
    Refuse({arguments.source}, "names no recording; give the report the recording itself");
  }
  output.AddInputs(InputsOf(*recording));
  const PreparedLog log = ReadAndPrepare(*recording);
  // of a refused estimate the fit is made again, so that the page can show it
  return LogReport(
      log, shown::WithFitAgain(estimate, log),
      {JoinCommand({"warmjoint", "report", arguments.source, "-o", arguments.output})});
}

/// Of robot.json alone, without the logs.
shown::ShownData RobotReport(const fs::path& source) {
  shown::ShownData data;
  data.facts = {{"source", source.string()},
                {"answer", RobotEstimateToTree(ReadRobotEstimate(source))}};
  return data;
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

/// Of a recording, an estimate or a robot's answer.
ReportPage FileReport(const ReportArguments& arguments, Activity& activity) {
  // a log has no place of its own for the page
  if (arguments.output.empty()) {
    Refuse({arguments.source}, "is a log: name the page that is to be made, as -o page.html");
  }
  std::vector<fs::path> inputs = InputsOf(arguments.recording);
  inputs.emplace_back(arguments.source);
  ReportPage page{Outputs({arguments.output}, inputs), arguments.output, "log", {}};
  if (!IsEstimate(arguments.source)) {
    page.data = RecordingReport(arguments, activity);
  } else if (IsRobotEstimate(ReadJsonNode(arguments.source))) {
    page.kind = "robot";
    page.data = RobotReport(arguments.source);
  } else {
    page.data = EstimateReport(arguments, page.output);
  }
  return page;
}

ExitStatus Report(const ReportArguments& arguments) {
  Activity activity("reading " + arguments.source);
  // a run by its directory, a log by its file
  if (!fs::exists(arguments.source)) {
    Refuse({arguments.source},
           "is not there; give a directory of `run`, a recording or an estimate file");
  }
  const Backend backend;
  ReportPage page = fs::is_directory(arguments.source) ? RunReport(arguments, activity)
                                                       : FileReport(arguments, activity);

  // the page as a whole, and where it lies
  activity.Is("drawing the page");
  page.output.Add(page.target, backend.FillPage(page.kind, std::move(page.data)));
  page.output.Write();
  activity.Aside([&] { Say(WordsBeside({page.target}), "{}\n", page.target.string()); });
  return ExitStatus::done;
}

}  // namespace

Command AddReportCommand(CLI::App& program) {
  auto arguments = std::make_shared<ReportArguments>();
  CLI::App* parser = program.add_subcommand(
      "report",
      "One web page that explains a run, a log and what was identified from it, or robot.json");
  AddValue(*parser, "SOURCE", "SOURCE", arguments->source,
           "directory of `run`, recording, estimate file (.json) whose recording is there, or "
           "robot.json")
      ->required();
  AddValue(*parser, "-o,--output", "FILE", arguments->output,
           "the page; RUN/report.html where it is not given for a run");
  GiveExample(*parser, "warmjoint report estimate.json -o report.html");
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
