// Identifier `nominal-ls`: a nominal law by linear least squares, Eqs. (7)-(9).
#pragma once

#include "identification/identifier.h"

namespace warmjoint {

/// x = argmin |A x - tau|, rows of A as in Eq. (9): [v, sign v] for law (2). Standard deviations
/// from s^2 (A^T A)^-1 with s^2 = |A x - tau|^2 / (n - d), noise taken as white.
/// not_identifiable where the motion makes columns of A alike, bad_data where nothing can be
/// fitted.
Identifier NominalLs();

}  // namespace warmjoint
