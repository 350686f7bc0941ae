// Law, gravity and inertia by least squares, with heat or without: the fit that nominal-ls and energy-ml make.
#pragma once

#include <string>

#include "identification/fit/fit.h"
#include "identification/fit/identifier.h"
#include "identification/options.h"

namespace warmjoint {

/// (p, k, tau, ...) = argmin sum over the kept samples of (tau - F - G - M a)^2, maximum likelihood for white noise on
/// the torque: without heat by linear least squares, Eqs. (7)-(9); with heat over the closed loop (19)-(22), from a
/// scan over tau. The options say what more there is: gravity, inertia with motion of any kind, E(0) of each recording,
/// jumps of E at gaps, Huber's loss, a lag of the torque, and its delay with motion of any kind (torque_delay.h). What they do
/// not name is left out. Where the noise is coloured beyond doubt, law and heat are fitted once
/// more to whitened rows, unless that changes more than noise may (hausman_test.h).
/// not_identifiable where the motion does not distinguish the columns, or where the warm-up cannot be seen: its share of
/// the residual is not beyond chance, or tau is not known to better than a factor of about e. name: of the identifier
Fit FitLaw(const std::string& name, const IdentifierInput& given, PartFit heat);

}  // namespace warmjoint
