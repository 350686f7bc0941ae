// warmjoint identify RECORDING: friction from a log.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "models/foundation/atomic_file.h"
#include "models/foundation/parse_number.h"
#include "sim/model/minimal_model.h"
#include "tools/actions/identify_by_command.h"
#include "tools/actions/identify_recording.h"
#include "tools/actions/outputs.h"
#include "tools/cli/command.h"
#include "tools/cli/estimate_table.h"
#include "tools/cli/follow_options.h"
#include "tools/cli/identify_arguments.h"
#include "tools/cli/identify_several.h"
#include "tools/cli/recording_options.h"
#include "tools/cli/take_project.h"
#include "tools/parser/choice.h"
#include "tools/report/draw/page_setting.h"
#include "tools/report/figures/fit_page.h"
#include "tools/terminal/activity.h"
#include "tools/terminal/say.h"

namespace warmjoint::inline tools {
namespace {

/// What --holdout asks for.
HoldOutSource ReadHoldOut(const IdentifyArguments& arguments) {
  // a number is a share; what is none names another recording
  const std::optional<double> fraction = ParseNumber(arguments.holdout);
  if (!fraction) {
    RecordingArguments other = arguments.recording;
    other.recordings = {arguments.holdout};
    return {0, ReadAndPrepare(other)};
  }
  return HoldOutShare(*fraction);
}

/// Refuses outputs that cannot be written before any time is spent.
void CheckOutput(const std::string& path) {
  if (!path.empty()) AtomicFile{path};
}

/// measurements: of the log that the estimate tells of.
void WriteOutputs(const IdentifyArguments& arguments, const Estimate& estimate,
                  const Measurements& measurements, Activity& activity) {
  // the estimate, where it is asked for
  if (!arguments.output.empty()) {
    WriteWholeFile(arguments.output, EstimateFile(estimate, arguments.recording, arguments.output,
                                                  arguments.settings.follows));
  }

  // a model for MuJoCo needs a friction that can be trusted
  if (arguments.mjcf.empty()) return;
  if (!estimate.friction || !estimate.friction->torque_unit.empty()) {
    activity.Aside([&] {
      Say(stderr, "{} is not written: there is no friction that MuJoCo can use\n", arguments.mjcf);
    });
    return;
  }
  WriteWholeFile(arguments.mjcf, MinimalModel(*estimate.friction, measurements.joint));
}

std::vector<std::filesystem::path> OutputsOf(const IdentifyArguments& arguments) {
  return {arguments.output, arguments.mjcf, arguments.plot};
}

/// Refuses outputs that are inputs too, or cannot be written, before any time is spent.
void CheckOutputs(const IdentifyArguments& arguments) {
  // the recording, and what else is read, must not be written over
  std::vector<std::filesystem::path> inputs(arguments.recording.recordings.begin(),
                                            arguments.recording.recordings.end());
  inputs.emplace_back(arguments.holdout);
  inputs.emplace_back(arguments.follow.file);
  KeepApart(OutputsOf(arguments), inputs);

  // every output can be opened, and its name tells a format that there is
  CheckOutput(arguments.output);
  CheckOutput(arguments.mjcf);
  CheckOutput(arguments.plot);
  if (!arguments.plot.empty()) report::FormatOf(arguments.plot);
}

/// Writes, draws and prints an estimate of the log.
ExitStatus Deliver(const IdentifyArguments& arguments, const Identified& identified,
                   const PreparedLog& log, Activity& activity) {
  const Measurements& measurements = log.taken().measurements;
  // friction in amperes is no use to MuJoCo, and says so where it is written
  const auto& [estimate, shown] = identified;
  Estimate written = estimate;
  const std::string notice = MarkAmperes(measurements, written);
  if (!notice.empty()) activity.Aside([&] { SayNotice("{}\n", notice); });

  // files and picture first, so that words follow what is there
  WriteOutputs(arguments, written, measurements, activity);
  if (!arguments.plot.empty()) {
    activity.Is("drawing " + arguments.plot);
    report::WriteFitPage(log, shown, arguments.plot);
  }

  // then the words, in the format that was asked for
  std::FILE* const words = WordsBeside(OutputsOf(arguments));
  activity.Aside([&] {
    if (arguments.format == "json") {
      if (IsStandardOutput(arguments.output)) return;  // there it is already
      fmt::print(
          words, "{}",
          EstimateFile(written, arguments.recording, arguments.output, arguments.settings.follows));
    } else {
      const Detail detail = arguments.explain ? Detail::full : Detail::brief;
      SayText(words, EstimateToText(estimate, measurements, PageOf(words), detail));
    }
  });
  return estimate.status == Status::ok ? ExitStatus::done : ExitStatus::nothing_trustworthy;
}

/// A command of the user's in the place of an identifier.
ExitStatus AskCommand(const IdentifyArguments& arguments) {
  // all that can be refused is, before the command is started
  if (arguments.follow.are_given()) {
    Refuse({"--follows"}, "is for identifiers of the list: a command learns nothing of it");
  }
  const CheckedCommand task =
      CheckCommand(SettingsOf(arguments, arguments.identifiers.front()), arguments.confinement);
  CheckOutputs(arguments);
  ReportConfinement({task.command}, {}, arguments.confinement);

  // the same log and the same judgement as for an identifier of the list
  Activity activity("reading the recording");
  const HoldOutSource holdout = ReadHoldOut(arguments);
  const PreparedLog log = ReadAndPrepare(arguments.recording);
  try {
    activity.Is("waiting for " + task.command.label);
    const Estimate estimate = IdentifyByCommand(task, log, holdout);
    return Deliver(arguments, {estimate, estimate}, log, activity);
  } catch (const NoAnswer& failure) {
    // without an answer there is nothing that can be trusted
    activity.Aside([&] {
      Say(stderr, "{} gave no answer ({}): {}\n", task.command.label, failure.status,
          failure.what());
    });
    return ExitStatus::nothing_trustworthy;
  }
}

/// Adds the heat that an earlier recording left, and tells it.
void TakeFollowed(const PreparedLog& log, Activity& activity, IdentifyArguments& arguments) {
  // read and, where it has no estimate yet, identified by the same settings
  if (!arguments.follow.are_given()) return;
  activity.Is("following " + arguments.follow.file);
  arguments.settings.follows =
      HeatBefore(arguments.follow, arguments.recording,
                 SettingsOf(arguments, arguments.identifiers.front()), log.taken().measurements);
  activity.Aside([&] { SayNotice("{}\n", Describe(*arguments.settings.follows)); });
}

ExitStatus Identify(IdentifyArguments arguments) {
  CheckFollow(arguments.follow, arguments.recording);
  if (arguments.identifiers.size() > 1) return IdentifySeveral(arguments);
  const std::string& identifier = arguments.identifiers.front();
  if (identifier.find('=') != std::string::npos) return AskCommand(arguments);

  // everything that can be refused is, before any time is spent
  IdentifySettings asked = SettingsOf(arguments, identifier);
  // a stand-in for the heat, which reading will tell
  if (arguments.follow.are_given()) asked.follows = CarriedHeat{{}, 0, {}, {}, {0}, {0}};
  CheckSettings(asked, JointOf(arguments.recording));
  CheckOutputs(arguments);

  // what is held out, the log, and the heat that an earlier recording left
  Activity activity("reading the recording");
  const HoldOutSource holdout = ReadHoldOut(arguments);
  const PreparedLog log = ReadAndPrepare(arguments.recording);
  TakeFollowed(log, activity, arguments);

  // now with the heat that was carried over
  const IdentifyTask task =
      CheckSettings(SettingsOf(arguments, identifier), JointOf(arguments.recording));
  const std::string fitting = fmt::format("fitting {} to {} samples", task.identifier.name,
                                          log.taken().measurements.size());
  activity.Is(fitting);
  const auto tell = [&](const std::string& words) { activity.Is(fitting + ", " + words); };
  return Deliver(arguments, IdentifyLog(task, log, holdout, tell), log, activity);
}

/// What is written, and how much is said.
void AddOutputOptions(CLI::App& parser, IdentifyArguments& arguments) {
  parser.add_option("-o,--output", arguments.output, "estimate.json; -: standard output")
      ->type_name("FILE");
  parser
      .add_option("--plot", arguments.plot, "picture of data, fit and verdict: .png, .svg or .pdf")
      ->type_name("FILE");
  parser.add_option("--mjcf", arguments.mjcf, "MuJoCo model of a joint with this friction")
      ->type_name("FILE");
  AddChoice(parser, "--format", arguments.format, {"text", "json"},
            "of what is printed; json: as in estimate.json");
  parser.add_flag("-v,--explain", arguments.explain,
                  "every remark, every test for lack of fit and every assumption");
  parser.add_flag("--force", arguments.force,
                  "show the numbers of an inadequate model with their intervals and write its\n"
                  "friction, all void; status and exit status 3 stay");
}

}  // namespace

Command AddIdentifyCommand(CLI::App& program) {
  auto arguments = std::make_shared<IdentifyArguments>();
  CLI::App* parser = program.add_subcommand("identify", "Friction from a log of one joint");
  // how the recording is read
  AddRecordingOptions(*parser, arguments->recording);
  AddHoldOptions(*parser, arguments->recording.holds);

  // which identifier, and what it is told
  parser
      ->add_option("--identifier", arguments->identifiers,
                   "see: warmjoint list identifiers; or a command of your own, as "
                   "'mine=python3 mine.py {recording} {estimate}'; given several times: a table of "
                   "their errors on held-out blocks")
      ->take_all()
      ->type_name("IDENTIFIER")
      ->capture_default_str();
  AddChoice(*parser, "--gravity", arguments->settings.gravity, {"none", "sincos", "paired"},
            "what gravity does to the torque: nothing, a sine of the angle, or what both "
            "directions share at each position");
  AddChoice(*parser, "--motion", arguments->settings.motion, {"chosen", "constant", "any"},
            "constant: samples at constant speed; any: all that move, with the inertia beside the "
            "friction; chosen: any where the log holds no speeds");

  // what else the verdict and its figures go by
  parser
      ->add_option(
          "--holdout", arguments->holdout,
          "share of the record's end, or another file, for figures on unseen data; 0: none")
      ->type_name("SHARE/FILE")
      ->capture_default_str();
  AddChoice(*parser, "--start", arguments->settings.start, {"cold", "unknown", "estimated"},
            "cold: intervals hold for a joint that was cold at the start; unknown: they reach as "
            "far as a slightly warm start moves them; estimated: E(0) is fitted",
            {{"warm", "unknown"}, {"hot", "unknown"}});
  AddFollowOptions(*parser, arguments->follow);
  parser
      ->add_option(
          "--relevance", arguments->settings.relevance,
          "change of the friction by lack of fit, as a share, from which a model is refused")
      ->type_name("NUMBER")
      ->capture_default_str();
  parser->add_option("--set", arguments->set, "option of the identifier, as law=asymmetric")
      ->type_name("KEY=VALUE")
      ->take_all();

  parser->add_flag_callback(
      "--unconfined", [arguments] { arguments->confinement = Confinement::none; },
      "run a command of your own without the sandbox: where the kernel has none, or they need a "
      "GPU");

  AddOutputOptions(*parser, *arguments);
  // the project file counts before anything is read
  return {parser, [arguments, parser] {
            TakeProject(*parser, arguments->recording);
            return Identify(*arguments);
          }};
}

}  // namespace warmjoint::inline tools
