// What `identify` does between its arguments and its outputs.
#pragma once

#include <warmjoint/identify.h>

#include <string>

#include "identification/answer/identify.h"
#include "tools/identify/carried_heat.h"
#include "tools/identify/recording_source.h"

namespace warmjoint {

/// Settings that were checked and looked up.
struct IdentifyTask {
  const Identifier& identifier;
  Options options;
  LackOfFitSettings judging;
  VoidNumbers void_numbers;
};

/// What the verdict is told of them. Throws BadInput for a relevance that is no share.
LackOfFitSettings LackOfFitSettingsOf(const IdentifySettings& settings);

/// Throws BadInput for names, words and numbers that cannot be used, and for what the identifier or
/// the kind of joint does not allow.
IdentifyTask CheckSettings(const IdentifySettings& settings, JointKind joint);

/// Lets the fit expect the heat that an earlier recording left. task: of settings with `follows`. Throws BadInput for
/// heat of two stages, of which identifiers fit one.
void BeginWith(const CarriedHeat& heat, IdentifyTask& task);

/// What is reported of a log, and what pictures show of it: of a fit that the verdict voids, its
/// numbers, too.
struct Identified {
  Estimate estimate;
  Estimate shown;
};

/// Fits, judges, reports, and adds the figures on what was held out to an answer that stands. The
/// narrator is told what is being tried.
Identified IdentifyLog(const IdentifyTask& task, const PreparedLog& log,
                       const HoldOutSource& holdout, const Narrator& narrator = {});

/// The heat with which `next` begins. Of an estimate.json its state_end; of a recording, read as `recording` says, that
/// of its own estimate by the same settings, from a cold start. Throws BadInput.
CarriedHeat HeatBefore(const EarlierRecording& earlier, const RecordingSource& recording,
                       const IdentifySettings& settings, const Measurements& next);

/// MuJoCo knows torques and forces: marks a friction in amperes as such and returns what to tell of
/// it; an empty text where nothing was done.
std::string MarkAmperes(const Measurements& measurements, Estimate& estimate);

}  // namespace warmjoint
