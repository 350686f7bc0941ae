// Estimate against truth: errors, coverage, and the bound that no unbiased estimate beats.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "identification/estimate.h"
#include "identification/preparation/prepared_log.h"
#include "models/recording/measurements.h"
#include "models/recording/selection.h"
#include "sim/truth/truth.h"

namespace warmjoint::inline identification {

/// One parameter of the truth.
struct ParameterScore {
  std::string name;
  double truth = 0;
  double estimate = 0;  // 0 where not estimated
  bool estimated = false;
  std::optional<bool> covered;  // the 95 % interval holds the truth; empty without an interval
  double bound = 0;             // Cramer-Rao standard deviation; NaN where it does not exist
};

/// Scores in two parametrisations, Eqs. (21) and (22) of the warming, and their NPE, Eq. (26).
struct Score {
  std::vector<ParameterScore> continuous;  // law, thermal_gain, thermal_time_constant
  std::vector<ParameterScore> discrete;    // law, thermal_gain_discrete, thermal_pole
  double npe_continuous = 0;
  double npe_discrete = 0;
  double bound_npe_continuous = 0;  // sqrt(sum((bound / truth)^2)): rms NPE at the bound, or NaN
  double bound_npe_discrete = 0;
};

/// The samples that an estimate is scored on: those of the log as it was taken at constant speed, or
/// all that move where it took motion of any kind.
const LogView& ScoredView(const Estimate& estimate, const PreparedLog& log);

/// Scores an estimate of the measurements behind which `truth` stands. Parameters are matched by
/// name: one of the truth that the estimate lacks (another law's, or the thermal ones of an
/// identifier without warming) counts as estimated 0 in the NPE. Parameters whose truth is 0 are
/// listed but left out of the NPE, which is relative. The discrete pair is that of the recording's
/// median sampling interval, for truth and estimate alike. The bounds count
/// E(0) as known unless the estimate holds it; with an acceleration, inertia and the gravity that was
/// fitted count as unknown.
Score ScoreEstimate(const Estimate& estimate, const Measurements& measurements,
                    const Selection& selection, const Truth& truth);

}  // namespace warmjoint::inline identification
