// warmjoint identify RECORDING: friction from a log.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "models/foundation/atomic_file.h"
#include "models/foundation/parse_number.h"
#include "sim/model/minimal_model.h"
#include "tools/actions/identify_recording.h"
#include "tools/actions/outputs.h"
#include "tools/cli/command.h"
#include "tools/cli/estimate_table.h"
#include "tools/cli/recording_options.h"
#include "tools/report/figures/fit_page.h"

namespace warmjoint::inline tools {
namespace {

struct IdentifyArguments {
  RecordingArguments recording;
  IdentifySettings settings;
  std::string holdout = "0.3";
  std::vector<std::string> set;
  std::string output;
  std::string mjcf;
  std::string plot;
  bool force = false;
};

/// What --holdout asks for.
HoldOutSource ReadHoldOut(const IdentifyArguments& arguments) {
  const std::optional<double> fraction = ParseNumber(arguments.holdout);
  if (!fraction) {
    RecordingArguments other = arguments.recording;
    other.recordings = {arguments.holdout};
    return {0, ReadAndPrepare(other)};
  }
  return HoldOutShare(*fraction);
}

/// The settings with --set and --force.
IdentifySettings SettingsOf(const IdentifyArguments& arguments) {
  IdentifySettings settings = arguments.settings;
  settings.options = ReadPairs(arguments.set, "--set");
  if (arguments.force) settings.void_numbers = VoidNumbers::show;
  return settings;
}

/// Refuses outputs that cannot be written before any time is spent.
void CheckOutput(const std::string& path) {
  if (!path.empty()) AtomicFile{path};
}

/// measurements: of the log that the estimate tells of.
void WriteOutputs(const IdentifyArguments& arguments, Estimate estimate,
                  const Measurements& measurements) {
  const std::string notice = TakeBackAmperes(measurements, estimate);
  if (!notice.empty()) fmt::print(stderr, "{}\n", notice);
  if (!arguments.output.empty()) {
    WriteWholeFile(arguments.output, EstimateFile(estimate, arguments.recording));
  }
  if (arguments.mjcf.empty()) return;
  if (!estimate.friction) {
    fmt::print(stderr, "{} is not written: there is no friction to trust\n", arguments.mjcf);
    return;
  }
  WriteWholeFile(arguments.mjcf, MinimalModel(*estimate.friction, measurements.joint));
}

ExitStatus Identify(const IdentifyArguments& arguments) {
  // everything that can be refused is, before any time is spent
  const IdentifyTask task = CheckSettings(SettingsOf(arguments), JointOf(arguments.recording));
  std::vector<std::filesystem::path> inputs(arguments.recording.recordings.begin(),
                                            arguments.recording.recordings.end());
  inputs.emplace_back(arguments.holdout);
  const std::vector<std::filesystem::path> outputs{arguments.output, arguments.mjcf,
                                                   arguments.plot};
  KeepApart(outputs, inputs);
  CheckOutput(arguments.output);
  CheckOutput(arguments.mjcf);
  CheckOutput(arguments.plot);
  const HoldOutSource holdout = ReadHoldOut(arguments);
  const PreparedLog log = ReadAndPrepare(arguments.recording);
  const auto& [measurements, selection] = log.taken();

  const Estimate estimate = IdentifyLog(task, log, holdout);
  WriteOutputs(arguments, estimate, measurements);
  if (!arguments.plot.empty()) {
    report::WriteFitPage(measurements, selection, estimate, arguments.plot);
  }
  fmt::print(WordsBeside(outputs), "{}", EstimateToText(estimate, measurements));
  return estimate.status == Status::ok ? ExitStatus::done : ExitStatus::nothing_trustworthy;
}

}  // namespace

Command AddIdentifyCommand(CLI::App& program) {
  auto arguments = std::make_shared<IdentifyArguments>();
  CLI::App* parser = program.add_subcommand("identify", "Friction from a log of one joint");
  AddRecordingOptions(*parser, arguments->recording);
  AddHoldOptions(*parser, arguments->recording.holds);
  parser
      ->add_option("--identifier", arguments->settings.identifier,
                   "see: warmjoint list identifiers")
      ->capture_default_str();
  parser->add_option("--gravity", arguments->settings.gravity, "none, sincos or paired")
      ->check(CLI::IsMember({"none", "sincos", "paired"}))
      ->capture_default_str();
  parser
      ->add_option(
          "--holdout", arguments->holdout,
          "share of the record's end, or another file, for figures on unseen data; 0: none")
      ->capture_default_str();
  parser
      ->add_option("--start", arguments->settings.start,
                   "cold: intervals hold for a joint that was cold at the start; unknown: they\n"
                   "reach as far as a slightly warm start moves them; estimated: E(0) is fitted")
      ->check(CLI::IsMember({"cold", "unknown", "estimated"}))
      ->capture_default_str();
  parser
      ->add_option("--relevance", arguments->settings.relevance,
                   "lack of fit, as a share of the friction, from which a model is refused")
      ->capture_default_str();
  parser->add_option("--set", arguments->set, "option of the identifier, as law=asymmetric")
      ->take_all();
  parser->add_option("-o,--output", arguments->output, "estimate.json");
  parser->add_option("--plot", arguments->plot, "picture of data, fit and verdict (PNG)");
  parser->add_option("--mjcf", arguments->mjcf, "MuJoCo model of a joint with this friction");
  parser->add_flag("--force", arguments->force,
                   "show the numbers of an inadequate model with their intervals and write its\n"
                   "friction, all void; status and exit status 3 stay");
  return {parser, [arguments] { return Identify(*arguments); }};
}

}  // namespace warmjoint::inline tools
