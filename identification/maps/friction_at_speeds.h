// Friction at three speeds of each direction: what law and maps tell together where neither is known alone.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/friction.h>

#include <vector>

#include "identification/maps/map_fit.h"

namespace warmjoint {

/// What law and maps brake with forwards and backwards at a low, the median and a high speed that the joint
/// held, with 95 % intervals. A constant that only the prior shares out between law and maps is no property of the
/// joint, but their sum is: the mean over those kept samples of one direction that move about as fast, within a fifth,
///     F(u) = mean of sign(v) F(v; the sample's place) = a x,   u = mean of |v|,
/// a linear function of law and weights x, whose variance is a C a^T with their covariance C. The speeds about which the
/// samples gather that are at 5, 50 and 95 % of |v|; one that is near another stands once. Of many samples every so
/// manieth counts. The warming E is left out.
/// known: about law, weights and maybe more; kept: [n x 5] points of the fit.
std::vector<FrictionAtSpeed> FrictionAtSpeeds(const Law& law, const MapFit& fit,
                                              const Uncertainty& known, const MapPoints& kept);

}  // namespace warmjoint
