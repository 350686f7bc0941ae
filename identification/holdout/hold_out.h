// Figures on samples that the fit has not seen.
#pragma once

#include <warmjoint/estimate.h>

#include <optional>
#include <string>

#include "identification/identifier.h"

namespace warmjoint {

/// A fit that has seen the samples before a time alone.
struct FirstPart {
  double split = 0;  // s
  Fit fit;
};

/// Fits the first 1 - fraction of the samples that take part, 0 < fraction < 1; where the fit of all samples chose
/// a structure (Fit::structure), that one. Nothing where fewer than two samples are left.
std::optional<FirstPart> FitFirstPart(const Identifier& identifier, const IdentifierInput& input,
                                      double fraction, const Fit& all_data);

/// Figures on what a fit has not seen, or why there are none.
struct HeldOut {
  std::optional<Metrics> metrics;
  std::string why_none;  // a clause; empty where there are figures
};

/// FitFirstPart, evaluated on the kept samples of the
/// rest. The prediction starts with the recording, at E(0) where the fit estimates it, so that the
/// joint comes to the test part as warm as it was. Where each recording has an E(0) of its own, those
/// that begin in the rest are left out. 0 < fraction < 1. None where that fit gives no friction or the
/// rest keeps no sample.
HeldOut HoldOut(const Identifier& identifier, const IdentifierInput& input, double fraction,
                const Fit& all_data = {});

/// Evaluates a fit of the identifier on the kept samples of another recording, which starts cold.
/// None where the fit gives no friction.
HeldOut HoldOut(const Identifier& identifier, const Fit& fit, const PreparedLog& other);

}  // namespace warmjoint
