// Law and warming of a joint whose torque is logged behind a lag.
#pragma once

#include <warmjoint/recording.h>

#include <functional>
#include <memory>

#include "identification/lagged/lagged_rows.h"
#include "identification/warming/thermal_fit.h"

namespace warmjoint {

/// A start from a level of friction, [N] sign(v) torque (ScanTimeConstant).
using StartFromLevel = std::function<InitialGuess(const Eigen::VectorXd& level)>;

/// Fits once more, behind the lag of the torque that leaves the least squares; from a fit without
/// one, whose place it takes. Returns the rows of that lag. Nothing, and the fit as it was, where the
/// log shows no lag (SearchLag). Losses follow from the friction itself, which no lag touches. Where the
/// fit without a lag went astray, it starts from the torque less what a lag of the law alone adds.
/// moving: the samples that count, none of them at rest; offsets: [N x q] sign(v) dG/dg; spread: [J] as
/// FitJumps returns it.
std::shared_ptr<const LaggedRows> FitWithTorqueLag(const Measurements& m, const Selection& moving,
                                                   const ClosedLoop& loop,
                                                   const Eigen::MatrixXd& offsets,
                                                   const Eigen::VectorXd& spread,
                                                   const StartFromLevel& scan, ThermalFit& fit);

}  // namespace warmjoint
