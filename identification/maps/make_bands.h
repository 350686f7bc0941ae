// How sure the friction along a map is, and at three speeds of each direction.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/friction.h>
#include <warmjoint/prepared_log.h>

#include <vector>

#include "identification/fit.h"
#include "identification/maps/map_fit.h"

namespace warmjoint {

/// One band for each map: law and all maps together at the map's centres, with 95 % for each place
/// by itself. Law and maps share constants that a prior alone splits, so that neither is known as
/// well as their sum is. A place is at the speed of its centre; where the map tells of the velocity but its direction, at
/// the median speed of the samples there, for at another one the law alone speaks, which the samples of one place cannot
/// tell from the map; where it has no axis of velocity, at the median speed forwards. The other maps count with their mean over the samples of
/// that direction. A map that is alike in both directions stands alone: no law imitates it. The
/// warming E is left out. Where a kernel has no data (MapFit::unseen), the spread of the seen ones joins
/// its deviation.
/// What kernels cannot follow is no noise and in no covariance; where a fit with twice as many follows more, the difference
/// f - f2 shows it:
///     E (f - f2)^2 = bias^2 + var (f - f2),
/// of which the second part is known from draws of noise and taken off. What is left, averaged over two neighbours on
/// each side along the first axis and at least 0, joins the variance.
/// problem: of the fit, its maps and rows are not read; uncertainty: about law, weights and maybe more.
/// Sets the fit's bands and bands_by_law.
void MakeBands(const Law& law, const MapProblem& problem, const MapFit& maps,
               const Uncertainty& uncertainty, Fit& fit);

/// Widens the band of a map over the motor's turn and speed by what the log cannot show of it: where in the turn a ripple is,
/// which it knows to a sample, since a torque that was filtered for its rate comes about as late. A harmonic of amplitude c
/// that turns by phi in a sample is a wave of 2 c sin(phi / 2) off then, 2 c for phi beyond pi; c is that of the band at its
/// speed, or, where a filter may have taken more than a little, at the slowest speed of the direction. Values stay: they are
/// what the torque of the log follows. reach: of the interval, in deviations
void WidenUnresolved(const FrictionMap& motor, const LogSamples& measurements, double reach,
                     MapBand& band);

/// What law and maps brake with forwards and backwards at a low, the median and a high speed that the joint
/// held, with 95 % intervals. A constant that only the prior shares out between law and maps is no property of the
/// joint, but their sum is: the mean over those kept samples of one direction that move about as fast, within a fifth,
///     F(u) = mean of sign(v) F(v; the sample's place) = a x,   u = mean of |v|,
/// a linear function of law and weights x, whose variance is a C a^T with their covariance C. The speeds about which the
/// samples gather that are at 5, 50 and 95 % of |v|; one that is near another stands once. Of many samples every so
/// manieth counts. The warming E is left out.
/// uncertainty: about law, weights and maybe more; kept: [n x 5] points of the fit.
std::vector<FrictionAtSpeed> FrictionAtSpeeds(const Law& law, const MapFit& fit,
                                              const Uncertainty& uncertainty,
                                              const MapPoints& kept);

}  // namespace warmjoint
