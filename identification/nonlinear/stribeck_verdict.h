// Whether a motion shows the Stribeck effect well enough to tell its two parameters.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "identification/identifier.h"
#include "identification/nonlinear/falling_law.h"
#include "identification/uncertainty/uncertainty.h"

namespace warmjoint {

/// What a fit says of its Stribeck effect.
struct StribeckEvidence {
  double fall = 0;            // ks - kc, N.m or N
  double fall_deviation = 0;  // its standard deviation
  double log_deviation = 0;   // standard deviation of ln(vs)
};

/// "the slowest constant speed is ...; hold several slower ones ...": the remedy of all verdicts on
/// missing slow speeds. selection: samples at constant speed.
std::string SlowSpeeds(const LogSamples& measurements, const Selection& selection);

/// Why not even the law without its fall, Eq. (2) or (3), can be told, which comes before any Stribeck
/// effect; nothing where it can. unknown: rows of the law that then cannot be told; rigid: [N x q] columns of gravity and inertia
/// beside it, or none.
std::optional<Refusal> UnknownSliding(const IdentifierInput& input, const FallingLaw& law,
                                      std::span<const ParameterInfo> unknown,
                                      const Eigen::MatrixXd& rigid = {});

/// A fit that does not come to rest.
Refusal NotConverged();

/// Why no scan finds a fall from the level at rest. selection: samples at constant speed.
Refusal NoFall(const FallingLaw& law, const LogSamples& measurements, const Selection& selection);

/// What a fit says of its effect. at: of x; uncertainty: of law and ln vs, at least, where x has them.
StribeckEvidence EvidenceOf(const FallingLaw& law, const Layout& at, const Eigen::VectorXd& x,
                            const Uncertainty& uncertainty);

/// Why ks and stribeck_velocity cannot be distinguished: vs is not known to a factor of e, or
/// ks - kc not to a half of itself. Nothing where they can.
std::optional<std::string> UnidentifiableStribeck(const FallingLaw& law,
                                                  const StribeckEvidence& evidence,
                                                  const LogSamples& measurements,
                                                  const Selection& selection);

}  // namespace warmjoint
