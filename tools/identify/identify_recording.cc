#include "tools/identify/identify_recording.h"

#include <fmt/format.h>

#include "identification/fit/seen_samples.h"
#include "identification/holdout/hold_out.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/identifiers/structures.h"
#include "identification/linear/rigid_part.h"
#include "identification/warming/initial_energy.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"

namespace warmjoint {
namespace {

/// Names of the identifiers whose options have it, with commas between them.
template <class Has>
std::string Able(Has has) {
  std::vector<std::string> able;
  for (const Identifier& one : Identifiers()) {
    if (has(one.options)) able.push_back(one.name);
  }
  return fmt::format("{}", fmt::join(able, ", "));
}

/// The same of a group of options.
template <class... Groups>
std::string AbleBy() {
  return Able([](const Options& options) { return (options.Find<Groups>() || ...); });
}

/// The option of any identifier that a mistyped name means; nothing where none is near, or the identifier's own is as near.
std::optional<std::string> MeantElsewhere(const std::string& name, const Identifier& identifier) {
  std::optional<std::string> nearest;
  // half of the letters right at least
  int least = static_cast<int>(name.size()) / 2 + 1;
  const auto look = [&](const Identifier& one) {
    for (const OptionInfo& info : one.options.List()) {
      const int distance = EditDistance(name, info.name);
      if (distance < least) {
        nearest = info.name;
        least = distance;
      }
    }
  };
  look(identifier);
  for (const Identifier& one : Identifiers()) look(one);
  if (nearest && identifier.options.Has(*nearest)) return std::nullopt;
  return nearest;
}

/// --set. Refuses what this identifier has no option for and others have.
Options ReadOptions(const std::map<std::string, std::string>& given, const Identifier& identifier) {
  for (const auto& [name, value] : given) {
    if (identifier.options.Has(name)) continue;
    const auto able = [](const std::string& option) {
      return Able([&](const Options& options) { return options.Has(option); });
    };
    if (const std::string those = able(name); !those.empty()) {
      Refuse({"--set"}, "{} has no option '{}'; name one that has it with --identifier: {}",
             identifier.name, name, those);
    }
    if (const auto meant = MeantElsewhere(name, identifier)) {
      Refuse({"--set"},
             "{} has no option '{}'; did you mean '{}'? Name one that has it with --identifier: {}",
             identifier.name, Excerpt(name), *meant, able(*meant));
    }
  }
  return identifier.options.Read(given, {"--set"});
}

/// With --start estimated, or --follows.
Options WithStart(const IdentifySettings& settings, const Identifier& identifier,
                  const Options& options) {
  if (settings.start != StartBelief::estimated && !settings.follows) return options;
  const char* option = settings.follows ? "--follows" : "--start";
  const auto* group = options.Find<InitialEnergyOptions>();
  if (!group) {
    Refuse({option}, "{} cannot estimate the heat at the start; use one of: {}", identifier.name,
           AbleBy<InitialEnergyOptions>());
  }
  // only one option may say how warm the joint is at the start
  const bool is_cold = settings.start == StartBelief::cold;
  if (settings.follows && (!is_cold || settings.options.contains("initial_energy"))) {
    Refuse({option}, "says how warm the joint is at the start, and so does {}; leave one of them",
           is_cold ? "--set initial_energy" : "--start");
  }
  InitialEnergyOptions start = *group;
  start.initial_energy = settings.follows ? StartOfHeat::expected : StartOfHeat::estimated;
  return options.With(start);
}

/// With --motion.
Options WithMotion(MotionKind motion, const Identifier& identifier, const Options& options) {
  if (motion == MotionKind::chosen) return options;
  if (const auto* given = options.Find<MotionOption>()) {
    MotionOption asked = *given;
    asked.motion = motion;
    return options.With(asked);
  }
  if (motion == MotionKind::constant && identifier.view == View::constant_speed) return options;
  Refuse({"--motion"}, "{} cannot be told which motion to learn from; use one of: {}",
         identifier.name, AbleBy<MotionOption>());
}

/// With --gravity.
Options WithGravity(FittedGravity gravity, const Identifier& identifier, JointKind joint,
                    const Options& options) {
  if (gravity == FittedGravity::none) return options;
  const auto* choosing = options.Find<AutoOptions>();
  if (!choosing && !options.Find<GravityOption>()) {
    Refuse({"--gravity"}, "{} cannot separate gravity from friction; use one of: {}",
           identifier.name, AbleBy<AutoOptions, GravityOption>());
  }
  // gravity over an angle needs one
  if (gravity == FittedGravity::sincos && joint == JointKind::linear) {
    Refuse({"--gravity"},
           "sincos needs an angle and the joint is linear, where gravity does not depend on "
           "position; use paired");
  }
  if (!choosing) return options.With(GravityOption{gravity});
  AutoOptions to_try = *choosing;
  to_try.gravity.kind = gravity;
  return options.With(to_try);
}

/// Expecting the heat that an earlier recording left, with the doubt that it has. Refuses heat of two stages, of which
/// identifiers fit one.
Options WithHeat(const CarriedHeat& heat, const IdentifyTask& task) {
  if (heat.energy.size() > 1) {
    Refuse({"--follows"}, "{} holds two stages of warming, and {} fits one", heat.file,
           task.identifier.name);
  }
  auto start = task.options.Get<InitialEnergyOptions>();
  start.expected_energy = heat.energy[0];
  start.expected_energy_std = heat.std[0];
  return task.options.With(start);
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
  JudgeHeldOut(held, answer);
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
  // --set first, and over that what has a setting of its own
  Options options = ReadOptions(settings.options, identifier);
  options = WithStart(settings, identifier, options);
  options = WithMotion(settings.motion, identifier, options);
  options = WithGravity(settings.gravity, identifier, joint, options);
  return {identifier, std::move(options), LackOfFitSettingsOf(settings), settings.void_numbers};
}

HoldOutSource HoldOutShare(double fraction) {
  if (!(fraction >= 0 && fraction < 1)) {
    Refuse({"--holdout"}, "is {}; it must be at least 0 and below 1, or a file", fraction);
  }
  return {fraction, std::nullopt};
}

Identified Identify(const IdentifyTask& task, const PreparedLog& log,
                    const IdentifyContext& context) {
  // what the identifier may look at
  const Options options = context.follows ? WithHeat(*context.follows, task) : task.options;
  const IdentifierInput given{log, options, context.start, context.narrator};

  // the fit, what was found in it, and what that leaves of it; then how it does on unseen samples
  Answer answer = FitAndCheck(task.identifier, given, task.judging);
  const IdentifierInput input = InputOf(answer, task.identifier, given);
  const HeldOut held = HoldOutBeside(task.identifier, input, context.holdout, answer);

  // what is reported; numbers of a refused fit are shown where that was asked for
  const Estimate reported = ReportAnswer(task.identifier, input, answer);
  Identified identified{reported, reported};
  auto& [estimate, shown] = identified;
  if (answer.judged.refused) {
    shown = ReportAnswer(task.identifier, input, answer, RefusedNumbers::show);
  }
  if (task.void_numbers == VoidNumbers::show) {
    estimate = shown;
  } else {
    shown.message = estimate.message;
  }

  // what belongs to both
  for (Estimate* one : {&estimate, &shown}) {
    one->holdout = held.metrics;
    one->without_holdout = held.why_none;
    one->follows = context.follows;
    MarkAmperes(log.raw().measurements, *one);
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
  const Estimate estimate = Identify(task, log).estimate;
  return CarryOver(HeatLeftBy(estimate, file), earlier.pause, next);
}

void MarkAmperes(const Measurements& measurements, Estimate& estimate) {
  if (!estimate.friction || measurements.torque_unit == kTorqueUnit.For(measurements.joint)) return;
  estimate.friction->torque_unit = measurements.torque_unit;
}

Estimate Identify(const PreparedLog& log, IdentifySettings settings, const HoldOutSource& holdout,
                  const std::optional<CarriedHeat>& follows, const Narrator& watch) {
  HoldOutShare(holdout.fraction);
  settings.follows = follows.has_value();
  const IdentifyTask task = CheckSettings(settings, log.raw().measurements.joint);
  return Identify(task, log, {holdout, follows, {}, watch}).estimate;
}

}  // namespace warmjoint
