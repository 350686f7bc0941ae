// Of the friction that was found: where it drives the joint, how much of the torque it explains, how well it is known.
#pragma once

#include <warmjoint/estimate.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "identification/fit.h"
#include "identification/sentences/moved_parameter.h"

namespace warmjoint {

/// Of a fitted friction that drives the joint at a time, s.
std::string ExplainDriving(double time, std::string_view remedy);
/// What to try then, which the fit does not hold already: another law, else gravity, else the torque's sign.
/// law: of the fit; gravity: its option.
std::string RemedyForNonDissipative(std::string_view law,
                                    FittedGravity gravity = FittedGravity::none);

/// Of a fit that the torque's mean beats. fit_share: Fit, %
std::string ExplainWorseThanMean(double fit_share, const Fit& fit);
/// Of one that explains little of the torque in both directions, and of one that the mean of unseen samples beats, %.
std::string ExplainPoorFit(double fit_share, double least, const Fit& fit);
std::string ExplainWorseHeldOut(double fit_share, const Fit& fit);
/// Of one that leaves much of the torque, compared with the friction that it finds, both rms.
std::string ExplainMuchLeft(double left, double friction, const Fit& fit);
/// Of a torque without friction, which has that share of it, and of an inertia below 0.
std::string ExplainNoFriction(double share);
std::string ExplainNegativeInertia(const FitParameter& inertia,
                                   const std::array<double, 2>& interval95);

/// "friction forwards at 0.5 rad/s, warm".
std::string NameOfFriction(const FrictionAtSpeed& at);
/// Of friction at speeds whose intervals reach to 0: of all, and of some that are left out.
std::string ExplainUnknownFriction(const std::vector<FrictionAtSpeed>& all);
std::string ExplainLeftOutSpeeds(const std::vector<FrictionAtSpeed>& left_out);

// of an estimate of others
inline constexpr const char* kHoldsNoFriction = "the estimate holds no friction";
/// Of one whose own law fits its log better. moved: the parameter that is farthest off
std::string ExplainOwnLaw(const MovedParameter& moved);

}  // namespace warmjoint
