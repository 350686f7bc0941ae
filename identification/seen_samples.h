// The samples of a log that an identifier learns from.
#pragma once

#include "identification/identifier.h"

namespace warmjoint::inline identification {

/// The input with the samples that the identifier learns from: those of its regime; of one that has the
/// option `motion`, all that move where that asks for them, or where the log shows no constant speeds.
IdentifierInput Seen(const Identifier& identifier, const IdentifierInput& input);

}  // namespace warmjoint::inline identification
