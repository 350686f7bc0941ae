#include "tools/identify/identify_recording.h"

#include <fmt/format.h>

#include "identification/estimate.h"
#include "identification/holdout/hold_out.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/warming/initial_energy.h"
#include "models/foundation/bad_input.h"

namespace warmjoint {
namespace {

constexpr const char* kStartOption = "initial_energy";

/// Names of the identifiers with an option, with commas between them.
std::string Able(std::string_view option) {
  std::vector<std::string> able;
  for (const Identifier& one : Identifiers()) {
    if (one.options.Has(option)) able.push_back(one.name);
  }
  return fmt::format("{}", fmt::join(able, ", "));
}

/// Refuses what this identifier has no option for and others have.
void RefuseOptionsOfOthers(const std::map<std::string, std::string>& given,
                           const Identifier& identifier) {
  for (const auto& [name, value] : given) {
    const std::string able = identifier.options.Has(name) ? "" : Able(name);
    if (able.empty()) continue;
    Refuse({"--set"}, "{} has no option '{}'; name one that has it with --identifier: {}",
           identifier.name, name, able);
  }
}

/// --start estimated, or --follows, as options of the identifier.
void AddStart(const IdentifySettings& settings, const Identifier& identifier,
              std::map<std::string, std::string>& given) {
  if (settings.start != StartBelief::estimated && !settings.follows) return;
  const char* option = settings.follows ? "--follows" : "--start";
  if (!identifier.options.Has(kStartOption)) {
    Refuse({option}, "{} cannot estimate E(0); use one of: {}", identifier.name,
           Able(kStartOption));
  }
  // only one option may say how warm the joint is at the start
  if (settings.follows && (settings.start != StartBelief::cold || given.contains(kStartOption))) {
    Refuse({option}, "says how warm the joint is at the start, and so does {}; leave one of them",
           settings.start != StartBelief::cold ? "--start" : "--set initial_energy");
  }
  given[kStartOption] = settings.follows ? "expected" : "estimated";
}

/// --motion as an option of the identifier.
void AddMotion(MotionKind motion, const Identifier& identifier,
               std::map<std::string, std::string>& given) {
  if (motion == MotionKind::chosen) return;
  if (!identifier.options.Has("motion")) {
    if (motion == MotionKind::constant && identifier.view == View::constant_speed) return;
    Refuse({"--motion"}, "{} cannot be told which motion to learn from; use one of: {}",
           identifier.name, Able("motion"));
  }
  given["motion"] = NameOf(motion);
}

/// --set, and --start, --motion and --gravity as three of them.
std::map<std::string, std::string> GivenOptions(const IdentifySettings& settings,
                                                const Identifier& identifier, JointKind joint) {
  // the start and the motion first, then gravity
  auto given = settings.options;
  AddStart(settings, identifier, given);
  AddMotion(settings.motion, identifier, given);
  if (settings.gravity == FittedGravity::none) return given;
  if (!identifier.options.Has("gravity")) {
    Refuse({"--gravity"}, "{} cannot tell gravity from friction; use one of: {}", identifier.name,
           Able("gravity"));
  }
  // gravity over an angle needs one
  if (settings.gravity == FittedGravity::sincos && joint == JointKind::linear) {
    Refuse({"--gravity"},
           "sincos needs an angle and the joint is linear, where gravity does not depend on "
           "position; use paired");
  }
  given["gravity"] = NameOf(settings.gravity);
  return given;
}

/// The figures on what was held out, or why there are none; an answer that they contradict is refused.
HeldOut HoldOutBeside(const Identifier& identifier, const IdentifierInput& input,
                      const HoldOutSource& source, Answer& answer) {
  if (!source.other && source.fraction == 0) return {};
  // a failed fit to all data has no figures on others
  if (answer.inferred.status != Status::ok) {
    return {{}, fmt::format("the fit to all data is {}", StatusName(answer.inferred.status))};
  }
  // the fit as it is, on another recording, or a second fit to the first part, on the rest
  if (source.other) return HoldOut(identifier, answer.fit, *source.other);
  HeldOut held = HoldOut(identifier, input, source.fraction, answer.fit);
  if (held.metrics) JudgeHeldOut(*held.metrics, held.several_speeds, answer);
  return held;
}

}  // namespace

LackOfFitSettings LackOfFitSettingsOf(const IdentifySettings& settings) {
  if (!(settings.relevance > 0 && settings.relevance <= 1)) {
    Refuse({"--relevance"}, "is {}; it must be a share of the friction above 0 and at most 1",
           settings.relevance);
  }
  return {settings.relevance, settings.start};
}

IdentifyTask CheckSettings(const IdentifySettings& settings, JointKind joint) {
  const Identifier& identifier = FindIdentifier(settings.identifier);
  const auto given = GivenOptions(settings, identifier, joint);
  RefuseOptionsOfOthers(given, identifier);
  Options options = identifier.options.Read(given, {"--set"});
  return {identifier, std::move(options), LackOfFitSettingsOf(settings), settings.void_numbers};
}

void BeginWith(const CarriedHeat& heat, IdentifyTask& task) {
  if (heat.energy.size() > 1) {
    Refuse({"--follows"}, "{} holds two stages of warming, and {} fits one", heat.file,
           task.identifier.name);
  }
  // expected with the doubt that it has
  auto start = task.options.Get<InitialEnergyOptions>();
  start.expected_energy = heat.energy[0];
  start.expected_energy_std = heat.std[0];
  task.options = task.options.With(start);
}

HoldOutSource HoldOutShare(double fraction) {
  if (!(fraction >= 0 && fraction < 1)) {
    Refuse({"--holdout"}, "is {}; it must be at least 0 and below 1, or a file", fraction);
  }
  return {fraction, std::nullopt};
}

Identified IdentifyLog(const IdentifyTask& task, const PreparedLog& log,
                       const HoldOutSource& holdout, const Narrator& narrator) {
  const IdentifierInput given{log, task.options, {}, narrator};
  Answer answer = FitAndCheck(task.identifier, given, task.judging);
  const IdentifierInput input = InputOf(answer, task.identifier, given);
  const HeldOut held = HoldOutBeside(task.identifier, input, holdout, answer);
  Estimate reported = ReportAnswer(task.identifier, input, answer);
  Identified identified{reported, WithVoidNumbers(task.identifier, input, answer, reported)};
  // numbers of a refused fit are shown where that was asked for
  auto& [estimate, shown] = identified;
  if (task.void_numbers == VoidNumbers::show) {
    estimate = shown;
  } else {
    shown.message = estimate.message;
  }
  // figures on held-out samples belong to both
  for (Estimate* one : {&estimate, &shown}) {
    one->holdout = held.metrics;
    one->without_holdout = held.why_none;
  }
  return identified;
}

CarriedHeat HeatBefore(const EarlierRecording& earlier, const RecordingSource& recording,
                       const IdentifySettings& settings, const Measurements& next) {
  const std::string& file = earlier.file;
  // an estimate file says which heat its log left
  if (const auto left = HeatLeftIn(file)) return CarryOver(*left, earlier.pause, next);

  // a recording is identified first, from a cold start and without held-out figures
  RecordingSource before = recording;
  before.files = {file};
  IdentifySettings cold = settings;
  cold.follows = false;
  const PreparedLog log = ReadAndPrepare(before);
  const IdentifyTask task = CheckSettings(cold, before.read.joint);
  const Estimate estimate = IdentifyLog(task, log, {0, std::nullopt}).estimate;
  return CarryOver(HeatLeftBy(estimate, file), earlier.pause, next);
}

std::string MarkAmperes(const Measurements& measurements, Estimate& estimate) {
  const std::string_view unit = kTorqueUnit.For(measurements.joint);
  if (!estimate.friction || measurements.torque_unit == unit) return "";
  estimate.friction->torque_unit = measurements.torque_unit;
  return fmt::format(
      "friction is in {}, of use to predict, but not to MuJoCo: --torque-constant K, in {}/A at "
      "the joint, makes torque of the current",
      measurements.torque_unit, unit);
}

Estimate Identify(const PreparedLog& log, IdentifySettings settings, const HoldOutSource& holdout,
                  const std::optional<CarriedHeat>& follows, const Narrator& watch) {
  const Measurements& measurements = log.raw().measurements;
  HoldOutShare(holdout.fraction);
  settings.follows = follows.has_value();
  IdentifyTask task = CheckSettings(settings, measurements.joint);
  if (follows) BeginWith(*follows, task);
  Estimate estimate = IdentifyLog(task, log, holdout, watch).estimate;
  MarkAmperes(measurements, estimate);
  estimate.follows = follows;
  return estimate;
}

}  // namespace warmjoint
