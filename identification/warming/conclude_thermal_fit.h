// The answer of a joint fit of law and warming.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "identification/fit.h"
#include "identification/uncertainty/disagreement.h"
#include "identification/warming/thermal_fit_context.h"

namespace warmjoint {

/// How a fit was made.
struct ThermalPasses {
  const InitialGuess& scanned;
  const LoopResponse& response;                  // of the loop by the fit
  std::shared_ptr<const Whitening> whitening{};  // or none
  std::optional<Disagreement> structure{};       // why the rows were not whitened
  const char* behind = "";                       // what the summary says the rows stand behind
};

/// The loop by a fit.
LoopResponse WarmResponse(const ClosedLoop& loop, const ThermalFit& fit);

/// Rows of what is told of the heat: gain, time constant, E(0) where it was estimated, jumps.
std::vector<FitParameter> HeatTable(const ThermalFit& warm, const Measurements& measurements);

/// d(F + G)/dx over all samples, without lag. [N x p]
Eigen::MatrixXd WarmJacobian(const ClosedLoop& loop, const RigidPart& gravity,
                             const ThermalFit& fit);

/// E at the end of the log, with its slopes by law, heat, E(0) where it was estimated, and jumps. [p without gravity]
EndEnergy WarmEnd(const ClosedLoop& loop, const ThermalFit& fit);

/// The fit as a value, or why there is none to trust. name: of the identifier; nominal_squares: of the
/// fit without warming, its rows mapped as those of `robust`.
Fit ConcludeThermalFit(const char* name, const ThermalFitContext& course,
                       const ThermalPasses& passes, const RobustThermalFit& robust,
                       double nominal_squares);

}  // namespace warmjoint
