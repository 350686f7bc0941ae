// warmjoint check RECORDING: what a log holds, and what can be identified from it.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "identification/preparation/check_report.h"
#include "models/foundation/atomic_file.h"
#include "tools/actions/outputs.h"
#include "tools/cli/command.h"
#include "tools/cli/recording_options.h"
#include "tools/cli/take_project.h"
#include "tools/parser/choice.h"
#include "tools/report/draw/draw_figure.h"
#include "tools/report/figures/log_figure.h"
#include "tools/terminal/activity.h"
#include "tools/terminal/say.h"

namespace warmjoint::inline tools {
namespace {

struct CheckArguments {
  RecordingArguments recording;
  std::string format = "text";
  std::string segments;
  std::string plot;
};

/// The kept segments of a recording, a line for each. number: of the recording, from 1.
void AppendSegments(const PreparedLog& log, int number, std::string& csv) {
  const auto& [m, selection] = log.steady();
  for (const Segment& segment : selection.segments) {
    const auto kept = selection.keep.segment(segment.begin, segment.end - segment.begin).count();
    csv += fmt::format("{},{},{},{},{}\n", number, m.time[segment.begin], m.time[segment.end - 1],
                       segment.velocity, kept);
  }
}

ExitStatus Check(const CheckArguments& arguments) {
  const std::vector<std::filesystem::path> outputs{arguments.segments, arguments.plot};
  report::PageSetting setting;
  if (!arguments.plot.empty()) {
    setting.format = report::FormatOf(arguments.plot);
    AtomicFile{arguments.plot};
  }
  KeepApart(outputs,
            {arguments.recording.recordings.begin(), arguments.recording.recordings.end()});

  // an object for one recording, a list of them for several
  nlohmann::json checks = nlohmann::json::array();
  std::string text;
  std::string segments = "recording,begin,end,velocity,samples\n";
  int number = 0;
  Activity activity("reading the recording");
  for (Measurements& recording : ReadRecordings(arguments.recording)) {
    activity.Is("checking " + recording.source);
    const PreparedLog log = Prepare(std::move(recording), arguments.recording.holds);
    AppendSegments(log, ++number, segments);
    if (number == 1 && !arguments.plot.empty()) {
      const auto& [measurements, selection] = log.taken();
      const report::Figure figure =
          report::MakeLogFigure(report::MakeFitView(measurements, selection, {}));
      WriteWholeFile(arguments.plot, report::EncodeFigure(figure, setting).bytes);
    }
    const RecordingCheck check = CheckRecording(log);
    checks.push_back(CheckToJson(check));
    text += (text.empty() ? "" : "\n") + CheckToText(check);
  }
  if (!arguments.segments.empty()) WriteWholeFile(arguments.segments, segments);
  activity.Aside([&] {
    if (arguments.format == "json") {
      fmt::print(WordsBeside(outputs), "{}\n",
                 (checks.size() == 1 ? checks.front() : checks).dump(2));
    } else {
      SayText(WordsBeside(outputs), text);
    }
  });
  return ExitStatus::done;
}

}  // namespace

Command AddCheckCommand(CLI::App& program) {
  auto arguments = std::make_shared<CheckArguments>();
  CLI::App* parser =
      program.add_subcommand("check", "What a log holds, and what can be identified from it");
  AddRecordingOptions(*parser, arguments->recording);
  AddHoldOptions(*parser, arguments->recording.holds);
  parser
      ->add_option("--segments", arguments->segments,
                   "the constant speeds that are kept, as CSV: begin and end in s, velocity in SI")
      ->type_name("FILE");
  parser
      ->add_option("--plot", arguments->plot,
                   "picture of the (first) recording with its kept segments: .png, .svg or .pdf")
      ->type_name("FILE");
  AddChoice(*parser, "--format", arguments->format, {"text", "json"}, "of what is printed");
  return {parser, [arguments, parser] {
            TakeProject(*parser, arguments->recording);
            return Check(*arguments);
          }};
}

}  // namespace warmjoint::inline tools
