// Identifier `auto`: chooses the structure, then identifies it.
#pragma once

#include "identification/identifier.h"

namespace warmjoint::inline identification {

/// Tries the laws, cold and warm, with the Stribeck effect (with a level for each direction where what
/// it leaves pushes in one), and with maps over position, and over the motor's angle where a gear is
/// given. Drops those that the recording cannot identify, and
/// those to which BIC prefers a simpler one; compares the rest by the error on contiguous blocks
/// that each has not seen (blocked_hold_out.h) and takes the simplest that is not worse than the
/// best beyond doubt (structure_choice.h). The fit is that structure's on all the data; the
/// message says why and lists all candidates.
///
/// not_identifiable where the motion cannot tell viscous from coulomb: then no law can be chosen.
Identifier Auto();

}  // namespace warmjoint::inline identification
