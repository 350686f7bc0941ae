// warmjoint identify RECORDING: friction from a log.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "identification/estimate.h"
#include "identification/fields/field_set.h"
#include "models/foundation/atomic_file.h"
#include "models/foundation/parse_number.h"
#include "sim/model/friction_actuator.h"
#include "tools/actions/outputs.h"
#include "tools/cli/backend.h"
#include "tools/cli/command.h"
#include "tools/cli/estimate_table.h"
#include "tools/cli/foretold_table.h"
#include "tools/cli/recording_options.h"
#include "tools/cli/typed_options.h"
#include "tools/identify/identify_recording.h"
#include "tools/shown/estimate_data.h"
#include "tools/suite/external_identifier.h"
#include "tools/terminal/progress_line.h"
#include "tools/terminal/say.h"

namespace warmjoint {
namespace {

struct IdentifyArguments {
  RecordingSource recording;
  IdentifySettings settings;
  EarlierRecording earlier;
  std::vector<std::string> identifiers{IdentifySettings{}.identifier};
  std::string holdout = "0.3";
  std::vector<std::string> set;
  std::string fields;  // the option of that name; empty: its default
  std::string output;
  std::string mjcf;
  std::string plot;
  std::string design;  // whose foretold answer is shown beside
  std::string format = "text";
  bool explain = false;
  bool force = false;
  Confinement confinement = Confinement::sandbox;  // of commands
};

/// One of --identifier with all that can be refused checked: of the list, or a command.
struct Asked {
  std::string name;
  std::optional<IdentifyTask> task;
  std::optional<CheckedCommand> command;
};

IdentifySettings SettingsOf(const IdentifyArguments& arguments, const std::string& identifier) {
  // the settings that all identifiers share, and what is this one's
  IdentifySettings settings = arguments.settings;
  settings.identifier = identifier;
  settings.options = ReadPairs(arguments.set, "--set");
  if (!arguments.fields.empty()) settings.options.insert_or_assign("fields", arguments.fields);
  settings.follows = arguments.earlier.is_given();
  if (arguments.force) settings.void_numbers = VoidNumbers::show;
  return settings;
}

Asked CheckIdentifier(const IdentifyArguments& arguments, const std::string& identifier) {
  const IdentifySettings settings = SettingsOf(arguments, identifier);
  if (identifier.find('=') == std::string::npos) {
    return {identifier, CheckSettings(settings, arguments.recording.read.joint), std::nullopt};
  }
  CheckedCommand command = CheckCommand(settings, arguments.confinement);
  return {command.command.label, std::nullopt, std::move(command)};
}

/// What --holdout asks for.
HoldOutSource ReadHoldOut(const IdentifyArguments& arguments) {
  // a number is a share; what is none names another recording
  const std::optional<double> fraction = ParseNumber(arguments.holdout);
  if (!fraction) {
    RecordingSource other = arguments.recording;
    other.files = {arguments.holdout};
    return {0, ReadAndPrepare(other)};
  }
  return HoldOutShare(*fraction);
}

std::vector<std::filesystem::path> OutputsOf(const IdentifyArguments& arguments) {
  return {arguments.output, arguments.mjcf, arguments.plot};
}

/// The outputs, none of which is an input, before any time is spent.
Outputs ClaimOutputs(const IdentifyArguments& arguments) {
  // several identifiers give a table and no files
  const std::pair<const char*, const std::string&> of_one[]{{"--output", arguments.output},
                                                            {"--mjcf", arguments.mjcf},
                                                            {"--plot", arguments.plot},
                                                            {"--follows", arguments.earlier.file}};
  for (const auto& [option, value] : of_one) {
    if (arguments.identifiers.size() == 1 || value.empty()) continue;
    Refuse({option}, "is for one identifier, and {} are given", arguments.identifiers.size());
  }

  // the recording, and what else is read, must not be written over
  std::vector<std::filesystem::path> inputs = InputsOf(arguments.recording);
  inputs.emplace_back(arguments.holdout);
  inputs.emplace_back(arguments.earlier.file);
  inputs.emplace_back(arguments.design);
  if (!arguments.plot.empty()) PictureFormatOf(arguments.plot);
  return {OutputsOf(arguments), inputs};
}

/// Fits and judges, or asks the command. context: without a narrator
Answered Answer(const Asked& asked, const PreparedLog& log, IdentifyContext context,
                Activity& activity) {
  if (asked.task) {
    const std::string fitting =
        fmt::format("fitting {} to {} samples", asked.name, log.raw().measurements.size());
    activity.Is(fitting);
    context.narrator = [&](const std::string& words) { activity.Is(fitting + ", " + words); };
    return {asked.name, Identify(*asked.task, log, context), "", ""};
  }
  activity.Is("waiting for " + asked.name);
  try {
    const Estimate estimate = IdentifyByCommand(*asked.command, log, context.holdout);
    return {asked.name, Identified{estimate, estimate}, "", ""};
  } catch (const NoAnswer& failure) {
    return {asked.name, std::nullopt, failure.status, failure.what()};
  }
}

/// A model for MuJoCo, where one is asked for and there is a friction that can be trusted. measurements: of the log that was
/// identified.
void AddModel(const IdentifyArguments& arguments, const Estimate& estimate,
              const Measurements& measurements, Outputs& outputs, Activity& activity) {
  if (arguments.mjcf.empty()) return;
  if (!estimate.friction || !estimate.friction->torque_unit.empty()) {
    activity.Aside([&] {
      Say(stderr, "{} is not written: there is no friction that MuJoCo can use\n", arguments.mjcf);
    });
    return;
  }
  outputs.Add(arguments.mjcf, MinimalModel(*estimate.friction, measurements.joint));
}

/// Says that friction in amperes is of no use to MuJoCo.
void NoticeAmperes(const Estimate& estimate, JointKind joint, Activity& activity) {
  if (!estimate.friction || estimate.friction->torque_unit.empty()) return;
  activity.Aside([&] {
    SayNotice(
        "friction is in {}, of use to predict, but not to MuJoCo: --torque-constant K, in {}/A at "
        "the joint, makes torque of the current\n",
        estimate.friction->torque_unit, kTorqueUnit.For(joint));
  });
}

/// Writes, draws and prints an estimate of the log.
void Deliver(const IdentifyArguments& arguments, Identified identified, const PreparedLog& log,
             const std::optional<Backend>& backend, Outputs& outputs, Activity& activity) {
  const Measurements& measurements = log.raw().measurements;
  auto& [estimate, shown] = identified;
  NoticeAmperes(estimate, measurements.joint, activity);

  // files and picture first, so that words follow what is there
  estimate.recording = arguments.recording;
  const std::string file = EstimateToJson(estimate, arguments.output);
  outputs.Add(arguments.output, file);
  AddModel(arguments, estimate, measurements, outputs, activity);
  if (backend) {
    activity.Is("drawing " + arguments.plot);
    DrawRequest request{.figures = {"fit"}};
    request.sources.push_back({{"kind", "estimate"}, {"place", arguments.plot}});
    request.sources[0].update(shown::FitFacts(shown::MakeFitView(log, shown), request.data));
    outputs.Add(arguments.plot, PictureFor(arguments.plot, *backend, std::move(request)));
  }
  outputs.Write();

  // then the words, in the format that was asked for
  std::FILE* const words = WordsBeside(OutputsOf(arguments));
  activity.Aside([&] {
    if (arguments.format == "json") {
      // on standard output it is there already
      if (!IsStandardOutput(arguments.output)) fmt::print(words, "{}", file);
    } else {
      const Detail detail = arguments.explain ? Detail::full : Detail::brief;
      SayText(words, EstimateToText(estimate, measurements, PageOf(words), detail));
      if (!arguments.design.empty()) {
        SayText(words, ForetoldToText(ReadForetold(arguments.design), estimate, PageOf(words)));
      }
    }
  });
}

/// Several answers on one log: a table, or a list of what estimate.json holds.
void PrintSeveral(const IdentifyArguments& arguments, const std::vector<Answered>& answers,
                  const std::string& unit) {
  if (arguments.format != "json") {
    for (const Answered& one : answers) {
      if (!one.message.empty()) Say(stderr, "{}: {}\n", one.name, one.message);
    }
    Say(stdout, "{}", EstimatesToText(answers, unit, PageOf(stdout)));
    return;
  }
  Tree estimates = Tree::array();
  for (const Answered& one : answers) {
    estimates.push_back(
        one.identified
            ? EstimateToTree(one.identified->estimate)
            : Tree{{"identifier", one.name}, {"status", one.status}, {"message", one.message}});
  }
  fmt::print("{}\n", estimates.dump(2));
}

ExitStatus Identify(const IdentifyArguments& arguments) {
  // everything that can be refused is, before any time is spent
  CheckEarlier(arguments.earlier, arguments.recording.files.size());
  std::vector<Asked> asked;
  std::vector<SuiteIdentifier> commands;
  for (const std::string& identifier : arguments.identifiers) {
    asked.push_back(CheckIdentifier(arguments, identifier));
    if (asked.back().command) commands.push_back(asked.back().command->command);
  }
  if (!arguments.design.empty()) ReadForetold(arguments.design);
  Outputs outputs = ClaimOutputs(arguments);
  const std::optional<Backend> backend =
      arguments.plot.empty() ? std::nullopt : std::optional<Backend>(std::in_place);
  ReportConfinement(commands, {}, arguments.confinement);

  // what is held out, the log, and the heat that an earlier recording left
  Activity activity("reading the recording");
  IdentifyContext context{.holdout = ReadHoldOut(arguments)};
  const PreparedLog log = ReadAndPrepare(arguments.recording);
  activity.Aside([&] { TellNotes(log); });
  if (arguments.earlier.is_given()) {
    activity.Is("following " + arguments.earlier.file);
    context.follows =
        HeatBefore(arguments.earlier, arguments.recording,
                   SettingsOf(arguments, arguments.identifiers.front()), log.raw().measurements);
    activity.Aside([&] { SayNotice("{}\n", Describe(*context.follows)); });
  }

  // one answer that can be trusted is enough
  std::vector<Answered> answers;
  for (const Asked& one : asked) answers.push_back(Answer(one, log, context, activity));
  const bool any_ok = std::ranges::any_of(answers, [](const Answered& one) {
    return one.identified && one.identified->estimate.status == Status::ok;
  });
  const Answered& first = answers.front();
  if (answers.size() > 1) {
    activity.Aside([&] { PrintSeveral(arguments, answers, log.raw().measurements.torque_unit); });
  } else if (first.identified) {
    Deliver(arguments, *first.identified, log, backend, outputs, activity);
  } else {
    activity.Aside([&] {
      Say(stderr, "{} gave no answer ({}): {}\n", first.name, first.status, first.message);
    });
  }
  return any_ok ? ExitStatus::done : ExitStatus::nothing_trustworthy;
}

/// What is written, and how much is said.
void AddOutputOptions(CLI::App& parser, IdentifyArguments& arguments) {
  AddValue(parser, "-o,--output", "FILE", arguments.output, "estimate.json; -: standard output");
  AddValue(parser, "--plot", "FILE", arguments.plot,
           "picture of data, fit and verdict: .png, .svg or .pdf");
  AddValue(parser, "--mjcf", "FILE", arguments.mjcf, "MuJoCo model of a joint with this friction");
  parser.add_flag("-v,--explain", arguments.explain,
                  "every remark, every test for lack of fit and every assumption");
  AddValue(parser, "--design", "FILE", arguments.design,
           "design.json of `design`, whose foretold numbers stand beside those reached");
  AddChoice(parser, "--format", arguments.format, {"text", "json"},
            "of what is printed; json: as in estimate.json");
}

/// Which identifier, on which samples.
void AddIdentifierOptions(CLI::App& parser, IdentifyArguments& arguments) {
  AddChoice(parser, "--gravity", arguments.settings.gravity,
            "what gravity does to the torque: nothing, a sine of the angle, or what both "
            "directions share at each position");
  AddValue(parser, "--identifier", "NAME", arguments.identifiers,
           "see: warmjoint list identifiers; or a command of your own, as 'mine=python3 mine.py "
           "{recording} {estimate}'; given several times: a table with a row for each")
      ->take_all()
      ->capture_default_str();
  AddValue(parser, "--fields", "LIST", arguments.fields,
           std::string(kFieldsHelp) + "; auto has all, nominal-ls and energy-ml none");
  AddValue(parser, "--set", "KEY=VALUE", arguments.set,
           "option of the identifier, as law=asymmetric")
      ->take_all();
}

/// What the verdict and its figures go by.
void AddVerdictOptions(CLI::App& parser, IdentifyArguments& arguments) {
  BeginGroup(parser, "What is assumed and asked");
  AddChoice(parser, "--start", arguments.settings.start,
            "cold: intervals hold for a joint that was cold at the start; unknown: they reach as "
            "far as a slightly warm start moves them; estimated: the heat at the start is fitted",
            {{"warm", "unknown"}, {"hot", "unknown"}});
  AddFollowOptions(parser, arguments.earlier);
  AddChoice(parser, "--motion", arguments.settings.motion,
            "constant: samples at constant speed; any: all that move, with the inertia and the "
            "friction; chosen: any where the log holds no speeds");
  AddHoldOptions(parser, arguments.recording.prepare);
  AddValue(parser, "--holdout", "SHARE/FILE", arguments.holdout,
           "share of the record's end, or another file, for figures on unseen data; 0: none")
      ->capture_default_str();
  AddValue(parser, "--relevance", "NUMBER", arguments.settings.relevance,
           "change of the friction by lack of fit, as a share, from which a model is refused")
      ->capture_default_str();
  parser.add_flag("--force", arguments.force,
                  "show the numbers of an inadequate model with their intervals and write its "
                  "friction, all void; status and exit status 3 stay");
  parser.add_flag_callback(
      "--unconfined", [&arguments] { arguments.confinement = Confinement::none; },
      "run a command of your own without the sandbox: where the kernel has none, or they need a "
      "GPU");
}

}  // namespace

Command AddIdentifyCommand(CLI::App& program) {
  auto arguments = std::make_shared<IdentifyArguments>();
  CLI::App* parser = program.add_subcommand("identify", "Friction from a log of one joint");
  GiveExample(*parser, "warmjoint identify log.csv --unit position=deg -o estimate.json");
  // what most need first
  AddOutputOptions(*parser, *arguments);
  AddIdentifierOptions(*parser, *arguments);
  AddRecordingOptions(*parser, arguments->recording);
  AddVerdictOptions(*parser, *arguments);
  // the project file counts before anything is read
  return {parser, [arguments, parser] {
            TakeProject(*parser, arguments->recording);
            return Identify(*arguments);
          }};
}

}  // namespace warmjoint
