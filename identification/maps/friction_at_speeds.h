// Friction at three speeds: what law and maps tell together where neither is known alone.
#pragma once

#include <vector>

#include "identification/map_band.h"
#include "identification/maps/map_fit.h"
#include "models/friction/law.h"

namespace warmjoint::inline identification {

/// What law and maps brake with at the lowest, the median and the highest speed |v| of the kept
/// samples, with 95 % intervals. A constant that only the prior shares out between law and maps is
/// no property of the joint, but their sum is:
///     F(u) = mean over the samples near u of sign(v) F(sign(v) u; the sample's place) = a x,
/// a linear function of law and weights x, whose variance is a C a^T with their covariance C. The
/// samples near u are the tenth with the nearest |v|, and those within a thousandth: where the joint has not
/// moved at u, the samples do not tell F(u). A speed that is another by a thousandth stands once. Of many samples every
/// so manieth counts. The warming E is left out.
/// known: about law, weights and maybe more; kept: [n x 5] points of the fit.
std::vector<FrictionAtSpeed> FrictionAtSpeeds(const Law& law, const MapFit& fit,
                                              const Uncertainty& known, const MapPoints& kept);

}  // namespace warmjoint::inline identification
