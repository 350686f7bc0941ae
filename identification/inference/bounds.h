// The physical bounds of a friction: whether the values of a fit keep them, and whether its intervals reach into them.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "identification/fit/cause.h"
#include "identification/fit/fit.h"
#include "identification/fit/identifier.h"
#include "identification/inference/inference.h"

namespace warmjoint {

/// Whether the value of a law parameter lies outside of its bounds, by chance or not.
bool LeavesBounds(const std::vector<Unknown>& parameters);

/// Whether the fit's friction may be used: nothing refuses it, its values lie inside of their physical
/// bounds, and its static level is not below its Coulomb level. It is what Infer finds, without the covariance.
bool GivesFriction(const Fit& fit);

/// The row that refuses an answer some law parameter of which lies outside of its bound, or whose static level is below
/// its Coulomb level. by_noise: the inference from the noise alone.
std::optional<Cause> BeyondBounds(const Fit& fit, const Inference& by_noise);

/// Sets law parameters that lie outside of a bound within their intervals to it: what is beyond is noise. The others are
/// fitted again with these held, x += V_h (V_hh)^-1 (b - x_h), V the covariance of x. The model of the fit follows, so that the residual is
/// that of what is reported, and a row (Action::hold) changes the values of the answer. A fit stays as it is where a parameter
/// lies beyond its bound with its whole interval, and where it has maps (RepeatedFit holds their laws) or free gravity.
/// by_noise: of the fit, whatever its bounds; measurements: of the fit.
void HoldActiveBounds(const Inference& by_noise, const LogSamples& measurements, Fit& fit);

/// How a fit is made: of other samples, or with other options.
using MakeFit = std::function<Fit(const IdentifierInput&)>;

/// The fit itself, or, where it puts the inertia below 0 with its whole interval, which no joint has, the fit with an inertia
/// of 0. A row of that fit widens by the differences of both, Source::findings; its size is by how much the friction along the log
/// differs, rms over the samples that were used, N.m or N. Where there is no fit with an inertia of 0, the fit itself is refused.
/// fit: made of the input by `make`
Fit WithoutNegativeInertia(Fit fit, const IdentifierInput& input, const MakeFit& make);

/// A fit with its inertia and its friction within their bounds: WithoutNegativeInertia, EnforceBounds.
Fit FitWithinBounds(const MakeFit& make, const IdentifierInput& input);

}  // namespace warmjoint
