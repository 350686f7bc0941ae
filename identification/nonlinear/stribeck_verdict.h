// Whether a motion shows the Stribeck effect well enough to determine its two parameters.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "identification/fit/identifier.h"
#include "identification/nonlinear/falling_law.h"
#include "identification/uncertainty/uncertainty.h"

namespace warmjoint {

/// The figures of a fit that show how well its Stribeck effect is determined.
struct StribeckEvidence {
  double fall = 0;            // ks - kc, N.m or N
  double fall_deviation = 0;  // its standard deviation
  double log_deviation = 0;   // standard deviation of ln(vs)
};

/// "the slowest constant speed is ...; hold several slower ones ...": the remedy of all verdicts on
/// missing slow speeds. selection: samples at constant speed.
std::string SlowSpeeds(const LogSamples& measurements, const Selection& selection);

/// Why not even the law without its fall, Eq. (2) or (3), is identifiable, which is checked before any Stribeck
/// effect; nothing where it is. unknown: rows of the law that then are not identifiable; rigid: [N x q] columns of gravity and
/// inertia that are fitted with it, or none.
std::optional<Refusal> UnknownSliding(const IdentifierInput& input, const FallingLaw& law,
                                      std::span<const ParameterInfo> unknown,
                                      const Eigen::MatrixXd& rigid = {});

/// The refusal of a fit that did not converge.
Refusal NotConverged();

/// Why no scan finds a fall from the level at rest. selection: samples at constant speed.
Refusal NoFall(const FallingLaw& law, const LogSamples& measurements, const Selection& selection);

/// The figures of a fit about its Stribeck effect. at: of x; uncertainty: of law and ln vs, at least, where x has them.
StribeckEvidence EvidenceOf(const FallingLaw& law, const FallingPlaces& at,
                            const Eigen::VectorXd& x, const Uncertainty& uncertainty);

/// Why ks and stribeck_velocity cannot be distinguished: vs is not known to a factor of e, or
/// ks - kc not to a half of itself. Nothing where they can.
std::optional<std::string> UnidentifiableStribeck(const FallingLaw& law,
                                                  const StribeckEvidence& evidence,
                                                  const LogSamples& measurements,
                                                  const Selection& selection);

}  // namespace warmjoint
