// Identifier `stribeck`: the Stribeck law, with or without warming.
#pragma once

#include "identification/identifier.h"

namespace warmjoint::inline identification {

/// (kv, kc, ks, vs[, k, tau]) = argmin sum over the kept samples of (tau - F)^2, F the Stribeck law,
/// or the one with a level for each direction (kc+, kc- and kr for kc and ks), with a fixed exponent, closed over its losses by (19)-(22) where `warming` is estimated. Needs
/// no start: vs is scanned, and the three best are refined by Ceres on the law itself. Standard
/// deviations and 95 % intervals as in uncertainty.h, those of vs and tau through their logarithms.
///
/// not_identifiable where the motion cannot tell the law without its fall; where the level at rest and
/// stribeck_velocity explain no more than chance does; where vs is not known to a factor of e, or
/// ks - kc not to a half of itself, which is so when slow speeds are missing. inadequate_model
/// where friction rises from rest instead of falling. The trace holds the scan, by its vs.
Identifier StribeckIdentifier();

}  // namespace warmjoint::inline identification
