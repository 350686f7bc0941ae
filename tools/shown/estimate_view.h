// An estimate as its pictures need it.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/prepared_log.h>
#include <warmjoint/recording.h>

#include <optional>

#include "tools/shown/fit_view.h"

namespace warmjoint::shown {

/// An estimate, and the recording that it came from where that is at hand.
struct EstimateView {
  Estimate estimate;
  std::optional<LogSamples> measurements = std::nullopt;
  std::optional<FitView> fit = std::nullopt;  // with measurements
  /// The last part of the recording, predicted by a fit that has seen the rest alone.
  std::optional<FitView> held_out = std::nullopt;
};

/// Beside another recording than the one that was fitted.
EstimateView MakeEstimateView(Estimate estimate, const PreparedLog& other);

/// An estimate without a friction, as a refused one, with the numbers and the friction of its fit, by the
/// identifier and the options that it names: to be looked at, not to be used. As it was where it has a
/// friction, or its identifier is none of ours.
Estimate WithFitAgain(Estimate estimate, const PreparedLog& log);

/// With its own recording. Where the file holds no friction, that of its fit is made again; where it
/// holds figures on held-out samples, so is the fit that has not seen them.
EstimateView ViewOwnRecording(Estimate estimate, const PreparedLog& own);

}  // namespace warmjoint::shown
