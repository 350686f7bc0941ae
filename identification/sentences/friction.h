// Of the friction that was found: where it drives the joint, how much of the torque it explains, how well it is known.
#pragma once

#include <warmjoint/estimate.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "identification/fit/fit.h"
#include "identification/sentences/moved_parameter.h"

namespace warmjoint {

/// The sentence about a fitted friction that drives the joint at a time, s.
std::string ExplainDriving(double time, std::string_view remedy);
/// What to try then, which the fit does not hold already: another law, else gravity, else the torque's sign.
/// law: of the fit; gravity: its option.
std::string RemedyForNonDissipative(std::string_view law,
                                    FittedGravity gravity = FittedGravity::none);

/// The sentence about a fit that describes the torque worse than its mean does. fit_share: Fit, %
std::string ExplainWorseThanMean(double fit_share, const Fit& fit);
/// The sentence about a fit that explains little of the torque in both directions. fit_share: Fit, %
std::string ExplainPoorFit(double fit_share, double least, const Fit& fit);
/// The sentence about a fit that predicts unseen samples worse than the rest of the model does. with, without: rms that is left
std::string ExplainWorseHeldOut(double with, double without, const Fit& fit);
/// The sentence about a fit that leaves much of the torque, relative to the friction that it finds. left, friction: rms
std::string ExplainMuchLeft(double left, double friction, const Fit& fit);
/// The sentence about a torque that holds no friction. share: of the friction in the torque
std::string ExplainNoFriction(double share);

/// The sentence about an inertia below 0 without which there is no fit; the next is about one that was taken out. share: by which
/// that changes the friction
std::string ExplainNegativeInertia(const Unknown& inertia, const std::array<double, 2>& interval95);
std::string ExplainHeldInertia(const Unknown& inertia, const std::array<double, 2>& interval95,
                               double share);
/// Whether the torque's sign may be turned: not where friction is known to brake.
enum class TorqueSign { known, doubtful };
/// The sentence about one that changes the friction by more than a share, `relevance`. held: ExplainHeldInertia
std::string ExplainInertiaMatters(std::string_view held, double relevance, TorqueSign sign);

/// "friction forwards at 0.5 rad/s, warm".
std::string NameOfFriction(const FrictionAtSpeed& at);
/// The sentence about friction at speeds whose intervals reach to 0, where that is so at all speeds; the next is about some
/// that are left out.
std::string ExplainUnknownFriction(const std::vector<FrictionAtSpeed>& all);
std::string ExplainLeftOutSpeeds(const std::vector<FrictionAtSpeed>& left_out);

// of an estimate of others
inline constexpr const char* kHoldsNoFriction = "the estimate holds no friction";
/// The sentence about an estimate whose own law fits its log better. moved: the parameter that differs most
std::string ExplainOwnLaw(const MovedParameter& moved);

/// The sentence about a torque over time that no motion of the joint explains. share: of the friction
std::string ExplainTorqueOverTime(double share);
/// The sentence about a friction that drifts too much over a log. share, most: rms, of the friction
std::string ExplainDriftOfFriction(double share, double most);

}  // namespace warmjoint
