// The physical bounds of a friction: whether the values of a fit keep them, and whether its intervals reach into them.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "identification/fit/cause.h"
#include "identification/fit/fit.h"
#include "identification/fit/identifier.h"
#include "identification/inference/inference.h"

namespace warmjoint {

/// Whether the fit's friction may be used: nothing refuses it, its values lie inside of their physical
/// bounds, and its static level is not below its Coulomb level. It is what Infer finds, without the covariance.
bool GivesFriction(const Fit& fit);

/// The row that refuses an answer some law parameter of which lies outside of its bound, or whose static level is below
/// its Coulomb level. by_noise: the inference from the noise alone.
std::optional<Cause> BeyondBounds(const Fit& fit, const Inference& by_noise);

/// Rows of the law that noise alone puts outside of their bounds.
struct LeftByNoise {
  std::vector<Eigen::Index> columns;  // of x
  std::vector<double> gaps;           // from the value of each to its bound
  std::string sentence;
};
/// Those of a fit, where each bound lies within the 95 % interval of its row; nothing where none is left, or one with the whole interval.
/// by_noise: the inference of the fit, whatever its bounds
std::optional<LeftByNoise> FindLeftByNoise(const Fit& fit, const Inference& by_noise);

/// Gives the table, and the model with it, the values at x. Returns a row that holds: by how much the values change.
/// x: [p] coordinates of the estimated rows; held: columns of x that are at a bound
Cause HoldAt(const Eigen::VectorXd& x, const std::vector<Eigen::Index>& held, Fit& fit);

/// How a fit is made: of other samples, or with other options.
using MakeFit = std::function<Fit(const IdentifierInput&)>;

/// The same fit with the law within its physical bounds: values that noise puts outside (FindLeftByNoise) become those of the minimum
/// within the bounds, by the solver's step (Minimise) on the squares about x, which are quadratic there: (x - x0)^T H (x - x0), H^-1 the
/// covariance of x0 in white noise. A row (Action::hold) says by how much; intervals stay, and that of a row at its bound begins
/// there. A fit stays as it is where a row lies outside with its whole interval, and where it has maps, whose fits hold the law
/// themselves (RepeatedFit).
MakeFit WithinBounds(MakeFit make);

/// The fit, or, where it puts the inertia below 0 with its whole interval, which no joint has, the fit with an inertia
/// of 0. A row of that fit widens by the differences of both, Source::findings; its size is by how much the friction along the log
/// differs, rms over the samples that were used, N.m or N. Where there is no fit with an inertia of 0, the fit itself is refused.
Fit WithoutNegativeInertia(const MakeFit& make, const IdentifierInput& input);

}  // namespace warmjoint
