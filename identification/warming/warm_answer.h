// The answer of a joint fit of law and warming.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "identification/fit.h"
#include "identification/identifier.h"
#include "identification/linear/rigid_part.h"
#include "identification/uncertainty/disagreement.h"
#include "identification/warming/gaps.h"
#include "identification/warming/robust_warm_fit.h"
#include "identification/warming/scan_time_constant.h"

namespace warmjoint {

/// What a fit is made of.
struct WarmTask {
  const IdentifierInput& input;
  const Law& law;
  const RigidPart& gravity;
  const ClosedLoop& loop;
  const InitialGuess& scanned;
  const std::vector<LogGap>& gaps;
  const LoopResponse& response;  // of the loop by the fit
  std::shared_ptr<const Whitening> whitening;
  std::optional<Disagreement> structure;  // why the rows were not whitened
  const char* behind = "";                // what the summary says the rows stand behind
};

/// The loop by a fit.
LoopResponse WarmResponse(const ClosedLoop& loop, const WarmFit& fit);

/// Rows of what is told of the heat: gain, time constant, E(0) where it was estimated, jumps.
std::vector<FitParameter> HeatTable(const WarmFit& warm, const Measurements& measurements);

/// d(F + G)/dx over all samples, without lag. [N x p]
Eigen::MatrixXd WarmJacobian(const ClosedLoop& loop, const RigidPart& gravity, const WarmFit& fit);

/// E at the end of the log, with its slopes by law, heat, E(0) where it was estimated, and jumps. [p without gravity]
EndEnergy WarmEnd(const ClosedLoop& loop, const WarmFit& fit);

/// The fit as a value, or why there is none to trust. name: of the identifier; nominal_squares: of the
/// fit without warming, its rows mapped as those of `robust`.
Fit ConcludeWarm(const char* name, const WarmTask& task, const RobustWarmFit& robust,
                 double nominal_squares);

}  // namespace warmjoint
