// What a design foretold beside what its log gave.
#pragma once

#include <warmjoint/design.h>
#include <warmjoint/estimate.h>

#include <string>

#include "tools/terminal/say.h"

namespace warmjoint {

/// The answer that design.json foretold of its whole motion. Throws BadInput for another file.
ForetoldAnswer ReadForetold(const std::string& file);

/// A row for each parameter that both have, with value and standard deviation as foretold and as reached.
std::string ForetoldToText(const ForetoldAnswer& foretold, const Estimate& estimate,
                           const Page& page);

}  // namespace warmjoint
