// What `identify` does between its arguments and its outputs.
#pragma once

#include <warmjoint/identify.h>

#include <optional>

#include "identification/answer/identify.h"
#include "models/foundation/random_stream.h"
#include "tools/identify/carried_heat.h"
#include "tools/identify/recording_source.h"

namespace warmjoint {

/// Settings that were checked and looked up.
struct IdentifyTask {
  const Identifier& identifier;
  Options options;
  LackOfFitSettings judging{};
  VoidNumbers void_numbers = VoidNumbers::withhold;
};

/// What the verdict is told of them. Throws BadInput for a relevance that is no share.
LackOfFitSettings LackOfFitSettingsOf(const IdentifySettings& settings);

/// Throws BadInput for names, words and numbers that cannot be used, and for what the identifier or
/// the kind of joint does not allow.
IdentifyTask CheckSettings(const IdentifySettings& settings, JointKind joint);

/// What an identification knows beside settings and log.
struct IdentifyContext {
  HoldOutSource holdout{.fraction = 0};
  std::optional<CarriedHeat>
      follows{};        // of an earlier recording, where the settings have `follows`
  StartKey start{};     // for identifiers that draw their start
  Narrator narrator{};  // is told what is being tried
};

/// What is reported of a log, and what pictures show of it: of a fit that the verdict voids, its
/// numbers, too.
struct Identified {
  Estimate estimate;
  Estimate shown;
};

/// From a log to an estimate, for command line, suites and Python: fits, finds causes, applies them, adds the figures on what was
/// held out to an answer that stands, and reports. Throws BadInput for heat of two stages that is left by an earlier
/// recording, of which identifiers fit one.
Identified Identify(const IdentifyTask& task, const PreparedLog& log,
                    const IdentifyContext& context = {});

/// The heat with which `next` begins. Of an estimate.json its state_end; of a recording, read as `recording` says, that
/// of its own estimate by the same settings, from a cold start. Throws BadInput.
CarriedHeat HeatBefore(const EarlierRecording& earlier, const RecordingSource& recording,
                       const IdentifySettings& settings, const Measurements& next);

/// MuJoCo knows torques and forces: marks a friction in amperes as such.
void MarkAmperes(const Measurements& measurements, Estimate& estimate);

}  // namespace warmjoint
