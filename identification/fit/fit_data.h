// The first step of every identifier: checks of the data, with a sentence on what they lack.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "identification/fit/identifier.h"
#include "identification/kept_rows.h"

namespace warmjoint {

/// Why nothing can be fitted to these data: a number that is not finite, too few kept samples for
/// `parameters`, or a constant torque. Empty where the data can be used.
std::optional<std::string> Unusable(const IdentifierInput& input, int parameters);

/// Names of the columns that cannot be distinguished, and the motion that would distinguish them: one sentence.
/// mixed: names of law parameters.
std::string Indistinct(const std::vector<std::string>& mixed, const LogSamples& measurements,
                       const Selection& selection);

}  // namespace warmjoint
