// Friction at speeds: numbers of an answer that are well determined even where parameters trade off.
#pragma once

#include <warmjoint/prepared_log.h>

#include <optional>
#include <vector>

#include "identification/fit/cause.h"
#include "identification/inference/inference.h"
#include "identification/lack_of_fit/fitted_model.h"

namespace warmjoint {

/// The friction of the joint at the typical speeds of the kept samples (typical_speeds.h), forwards and backwards, in N.m or N
/// against the motion, with 95 % intervals:
///
///     F = sign(v) Fn(v; p) + E,
///
/// cold, E = 0, and, where law and heat were fitted, as warm as at the kept sample with the largest |E|. Its errors are those of the
/// fit's parameters, d C d^T, d the derivatives by law, heat and start, with the smallest degrees of freedom of those that it
/// depends on. With maps it is the cold friction that the fit has already (make_bands.h). None where the fit has no intervals.
/// inferred: of the fit, with the causes that the fit brought; model: of the fit, or none; m, selection: what it was fitted to
std::vector<SpeedFigure> SpeedFiguresOf(const Fit& fit, const Inference& inferred,
                                        const std::optional<FittedModel>& model,
                                        const LogSamples& m, const Selection& selection);

/// Where the joint moves at one speed each way, a law without a slope gives the friction there, of which any part may be
/// viscous: its levels have no interval, and a remark says what they are.
void NameOneSpeed(const LogSamples& m, const Selection& selection, Fit& fit);

/// A floor: friction that is not known is no answer. It refuses where every interval, with all causes applied, reaches from the
/// friction to 0. Where only some do, those figures are left out. Nothing where none does.
std::optional<Cause> UnknownFriction(const std::vector<SpeedFigure>& at_speeds,
                                     const std::vector<Cause>& causes);

}  // namespace warmjoint
