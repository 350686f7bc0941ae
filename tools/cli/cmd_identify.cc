// warmjoint identify RECORDING: friction from a log.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "identification/answer/identify.h"
#include "identification/holdout/hold_out.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/linear/fit_gravity.h"
#include "models/foundation/atomic_file.h"
#include "models/foundation/parse_number.h"
#include "sim/model/minimal_model.h"
#include "tools/cli/command.h"
#include "tools/cli/estimate_table.h"
#include "tools/cli/outputs.h"
#include "tools/cli/recording_options.h"
#include "tools/report/figures/fit_page.h"

namespace warmjoint::inline tools {
namespace {

struct IdentifyArguments {
  RecordingArguments recording;
  std::string identifier = "energy-ml";
  std::string gravity = "none";
  std::string holdout = "0.3";
  std::string start = "cold";
  double relevance = Judging{}.relevance;
  std::vector<std::string> set;
  std::string output;
  std::string mjcf;
  std::string plot;
  bool force = false;
};

/// What --holdout asks for: a fraction of the recording, or another recording.
struct HoldOutSource {
  double fraction = 0;
  std::optional<PreparedLog> other;
};

HoldOutSource ReadHoldOut(const IdentifyArguments& arguments) {
  const std::optional<double> fraction = ParseNumber(arguments.holdout);
  if (!fraction) {
    RecordingArguments other = arguments.recording;
    other.recordings = {arguments.holdout};
    return {0, ReadAndPrepare(other)};
  }
  if (!(*fraction >= 0 && *fraction < 1)) {
    Refuse({"--holdout"}, "is {}; it must be at least 0 and below 1, or a file", *fraction);
  }
  return {*fraction, std::nullopt};
}

/// Names of the identifiers that can do something, with commas between them.
std::string Able(bool (*can)(const Identifier&)) {
  std::vector<std::string> able;
  for (const Identifier& one : Identifiers()) {
    if (can(one)) able.push_back(one.name);
  }
  return fmt::format("{}", fmt::join(able, ", "));
}

/// --start estimated as an option of the identifier.
void AddStart(const Identifier& identifier, std::map<std::string, std::string>& given) {
  if (!identifier.Has("initial_energy")) {
    Refuse({"--start"}, "{} cannot estimate E(0); use one of: {}", identifier.name,
           Able([](const Identifier& one) { return one.Has("initial_energy"); }));
  }
  given["initial_energy"] = "estimated";
}

/// --set, and --start and --gravity as two of them.
std::map<std::string, std::string> GivenOptions(const IdentifyArguments& arguments,
                                                const Identifier& identifier) {
  auto given = ReadPairs(arguments.set, "--set");
  if (arguments.start == "estimated") AddStart(identifier, given);
  if (arguments.gravity == "none") return given;
  if (!TellsGravity(identifier)) {
    Refuse({"--gravity"}, "{} cannot tell gravity from friction; use one of: {}", identifier.name,
           Able(TellsGravity));
  }
  if (arguments.gravity == "sincos" && arguments.recording.joint == "linear") {
    Refuse({"--gravity"},
           "sincos needs an angle and the joint is linear, where gravity does not "
           "depend on position; use paired");
  }
  given["gravity"] = arguments.gravity;
  return given;
}

std::optional<Metrics> HoldOutFigures(const Identifier& identifier, const IdentifierInput& input,
                                      const Fit& fit, const HoldOutSource& source) {
  if (source.other) return HoldOut(identifier, fit, *source.other);
  if (source.fraction == 0) return std::nullopt;
  return HoldOut(identifier, input, source.fraction);
}

/// --relevance and --start as far as the verdict reads them.
Judging JudgingOf(const IdentifyArguments& arguments) {
  if (!(arguments.relevance > 0 && arguments.relevance <= 1)) {
    Refuse({"--relevance"}, "is {}; it must be a share of the friction above 0 and at most 1",
           arguments.relevance);
  }
  return {arguments.relevance,
          arguments.start == "unknown" ? StartBelief::unknown : StartBelief::cold};
}

/// Refuses outputs that cannot be written before any time is spent.
void CheckOutput(const std::string& path) {
  if (!path.empty()) AtomicFile{path};
}

/// The estimate as files hold it: MuJoCo knows torques and forces, so that a friction in amperes is
/// left out, and said to be.
Estimate ForFiles(Estimate estimate, const Measurements& measurements) {
  const std::string_view unit = kTorqueUnit.For(measurements.joint);
  if (!estimate.friction || measurements.torque_unit == unit) return estimate;
  fmt::print(
      stderr,
      "no `friction` is written for MuJoCo: parameters are in {}; multiply the column by the "
      "motor's constant to get {}\n",
      measurements.torque_unit, unit);
  estimate.friction.reset();
  return estimate;
}

void WriteOutputs(const IdentifyArguments& arguments, const Estimate& estimate, JointKind joint) {
  if (!arguments.output.empty()) {
    nlohmann::json file = EstimateToJson(estimate);
    file["recording"] = RecordingToJson(arguments.recording);
    WriteWholeFile(arguments.output, file.dump(2) + "\n");
  }
  if (arguments.mjcf.empty()) return;
  if (!estimate.friction) {
    fmt::print(stderr, "{} is not written: there is no friction to trust\n", arguments.mjcf);
    return;
  }
  WriteWholeFile(arguments.mjcf, MinimalModel(*estimate.friction, joint));
}

ExitStatus Identify(const IdentifyArguments& arguments) {
  // everything that can be refused is, before any time is spent
  const Identifier& identifier = FindIdentifier(arguments.identifier);
  const Options options(identifier.options, GivenOptions(arguments, identifier), {"--set"});
  const Judging judging = JudgingOf(arguments);
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

  const IdentifierInput input{log, options, {}};
  const Answer answer = FitAndJudge(identifier, input, judging);
  Estimate estimate = arguments.force ? WithVoidNumbers(identifier, input, answer)
                                      : ReportAnswer(identifier, input, answer);
  if (answer.inferred.status == Status::ok) {
    estimate.holdout = HoldOutFigures(identifier, input, answer.fit, holdout);
  }
  WriteOutputs(arguments, ForFiles(estimate, measurements), measurements.joint);
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
  parser->add_option("--identifier", arguments->identifier, "see: warmjoint list identifiers")
      ->capture_default_str();
  parser->add_option("--gravity", arguments->gravity, "none, sincos or paired")
      ->check(CLI::IsMember({"none", "sincos", "paired"}))
      ->capture_default_str();
  parser
      ->add_option(
          "--holdout", arguments->holdout,
          "share of the record's end, or another file, for figures on unseen data; 0: none")
      ->capture_default_str();
  parser
      ->add_option("--start", arguments->start,
                   "cold: intervals hold for a joint that was cold at the start; unknown: they\n"
                   "reach as far as a slightly warm start moves them; estimated: E(0) is fitted")
      ->check(CLI::IsMember({"cold", "unknown", "estimated"}))
      ->capture_default_str();
  parser
      ->add_option("--relevance", arguments->relevance,
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
