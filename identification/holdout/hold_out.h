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

/// FitFirstPart, evaluated on the kept samples of the
/// rest. The prediction starts with the recording, at E(0) where the fit estimates it, so that the
/// joint comes to the test part as warm as it was. 0 < fraction < 1. Nothing where that fit gives
/// no friction or the rest keeps no sample.
std::optional<Metrics> HoldOut(const Identifier& identifier, const IdentifierInput& input,
                               double fraction, const Fit& all_data = {});

/// Evaluates a fit of the identifier on the kept samples of another recording, which starts cold.
/// Nothing where the fit gives no friction.
std::optional<Metrics> HoldOut(const Identifier& identifier, const Fit& fit,
                               const PreparedLog& other);

/// Why HoldOut gives nothing for these arguments: a clause.
std::string WhyNoHoldOut(const Identifier& identifier, const IdentifierInput& input,
                         double fraction, const Fit& all_data);
std::string WhyNoHoldOut(const Identifier& identifier, const Fit& fit, const PreparedLog& other);

}  // namespace warmjoint
