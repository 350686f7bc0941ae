// What a joint fit of law and warming is refined by, from where it ended.
#pragma once

#include <warmjoint/recording.h>

#include <memory>
#include <vector>

#include "identification/uncertainty/whitening.h"
#include "identification/warming/gaps.h"
#include "identification/warming/thermal_fit.h"

namespace warmjoint {

/// Fits once more, the jumps of E at the gaps too; from a fit without them, whose place it takes. A gap that a fit does
/// not know may pass for a warm start that cools: where E(0) is free, the jumps are found beside a cold start as well,
/// E(0) after them, and of both ways the one is taken that leaves less.
/// loop: takes those jumps; level, offsets, kept: as of FitThermalFriction; scanned: where the fit began. Returns how far
/// the jumps may be. [J]
Eigen::VectorXd FitJumps(ClosedLoop& loop, const Eigen::VectorXd& level,
                         const Eigen::MatrixXd& offsets, const Eigen::VectorXd& kept,
                         const std::vector<LogGap>& gaps, const InitialGuess& scanned,
                         ThermalFit& fit);

/// Fits once more, the rows whitened by the colour of the residual that the fit leaves; from that
/// fit, whose place it takes. Returns that whitening. Nothing, and the fit as it was, where the noise
/// may be white (IsSurelyColoured) or the next fit does not settle. moving: the samples that count,
/// none of them at rest; spread: [J] as FitJumps returns it; response: of the loop by that fit. The trace goes on in
/// whitened squares.
std::shared_ptr<const Whitening> FitWhitened(const Measurements& m, const Selection& moving,
                                             const ClosedLoop& loop, const Eigen::VectorXd& level,
                                             const Eigen::MatrixXd& offsets,
                                             const Eigen::VectorXd& spread,
                                             const LoopResponse& response, ThermalFit& fit);

}  // namespace warmjoint
