// The uncertainty of the friction along a map, and at three speeds of each direction.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/friction.h>
#include <warmjoint/prepared_log.h>

#include <vector>

#include "identification/fit/fit.h"
#include "identification/maps/map_fit.h"

namespace warmjoint {

/// One band for each map: law and all maps together at the map's centres, with 95 % for each place
/// by itself. Law and maps share constants that a prior alone splits, so that neither is known as
/// well as their sum is. A place is at the speed of its centre. Where the map distinguishes only the direction of the velocity,
/// a place is at the median speed of the samples there, for at another speed only the law would change, which the samples of
/// one place cannot distinguish from the map. Where the map has no axis of velocity, a place is at the median speed forwards.
/// The other maps count with their mean over the samples of that direction. The band of a map that is alike in both directions
/// is of that map alone: no law imitates it. The warming E is left out. Where a kernel has no data (MapFit::unseen), the spread
/// of the seen ones joins its deviation.
/// Structure that kernels are too wide to follow is not noise, and not in the covariance. Where a fit with twice as many
/// kernels follows more of it, the difference f - f2 shows that:
///     E (f - f2)^2 = bias^2 + var (f - f2),
/// of which the second part is estimated from draws of noise and subtracted. What is left, averaged over two neighbours on
/// each side along the first axis and at least 0, joins the variance.
/// problem: of the fit, its maps and rows are not read; uncertainty: about law, weights and maybe more.
/// Sets the fit's bands and bands_by_law.
void MakeBands(const Law& law, const MapProblem& problem, const MapFit& maps,
               const Uncertainty& uncertainty, Fit& fit);

/// Widens the band of a map over the motor's turn and speed, since the log shows the phase of a ripple in the turn only to a
/// sample: a torque that was filtered for its sampling rate is late by about as much. A harmonic of amplitude c
/// that turns by phi in a sample is a wave of 2 c sin(phi / 2) off then, 2 c for phi beyond pi; c is that of the band at its
/// speed, or, where a filter may have attenuated it notably, at the slowest speed of the direction. The values stay, since they
/// are what the torque of the log follows. reach: of the interval, in deviations
void WidenUnresolved(const FrictionMap& motor, const LogSamples& measurements, double reach,
                     MapBand& band);

/// The friction of law and maps, forwards and backwards, at a low, the median and a high speed that the joint
/// held, with 95 % intervals. How a constant is divided between law and maps depends only on the prior and is no property of
/// the joint, but their sum is: the mean over those kept samples of one direction whose speed is about the same, within a
/// fifth,
///     F(u) = mean of sign(v) F(v; the sample's place) = a x,   u = mean of |v|,
/// a linear function of law and weights x, whose variance is a C a^T with their covariance C. The speeds about which the
/// samples gather that are at 5, 50 and 95 % of |v|; speeds that are near each other count once. Of many samples only one in
/// so many is used. The warming E is left out.
/// uncertainty: about law, weights and maybe more; kept: [n x 5] points of the fit.
std::vector<FrictionAtSpeed> FrictionAtSpeeds(const Law& law, const MapFit& fit,
                                              const Uncertainty& uncertainty,
                                              const MapPoints& kept);

}  // namespace warmjoint
