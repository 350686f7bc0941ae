// The identifiers of a suite, made ready to run.
#pragma once

#include <vector>

#include "models/foundation/bad_input.h"
#include "scenarios/suite_identifier.h"
#include "tools/suite/prepared_identifier.h"

namespace warmjoint::inline tools {

/// The suite's identifiers in its order. Throws BadInput from `place` for unknown names and
/// options.
std::vector<PreparedIdentifier> PrepareIdentifiers(const std::vector<SuiteIdentifier>& identifiers,
                                                   const Place& place);

}  // namespace warmjoint::inline tools
