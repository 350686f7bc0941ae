// Identifier `nominal-ls`: a nominal law by linear least squares, Eqs. (7)-(9).
#pragma once

#include "identification/identifier.h"

namespace warmjoint::inline identification {

/// x = argmin |A x - tau|, rows of A as in Eq. (9): [v, sign v] for law (2). Standard deviations
/// as in uncertainty.h, right for coloured noise too.
/// not_identifiable where the motion makes columns of A alike, bad_data where nothing can be
/// fitted.
Identifier NominalLs();

}  // namespace warmjoint::inline identification
