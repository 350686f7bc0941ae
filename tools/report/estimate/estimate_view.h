// An estimate as its pictures need it.
#pragma once

#include <optional>

#include "identification/estimate.h"
#include "models/recording/measurements.h"
#include "tools/report/figures/fit_view.h"

namespace warmjoint::report {

/// An estimate, and the recording that it came from where that is at hand.
struct EstimateView {
  Estimate estimate;
  std::optional<Measurements> measurements;
  std::optional<FitView> fit;  // with measurements
};

EstimateView MakeEstimateView(Estimate estimate, std::optional<Measurements> measurements);

}  // namespace warmjoint::report
