// load-map: friction over position, energy and load.
#pragma once

#include "identification/identifier.h"

namespace warmjoint::inline identification {

/// The paper's proposal P x E x L: a level that depends on the load which the joint transmits. The
/// recording must have the column `load`. Where no warm-up can be seen E is 0 and its axis left
/// out.
Identifier LoadMap();

}  // namespace warmjoint::inline identification
