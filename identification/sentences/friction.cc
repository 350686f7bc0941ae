#include "identification/sentences/friction.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "identification/command.h"
#include "models/friction/laws.h"

namespace warmjoint {
namespace {

/// A question about what may act on the joint in addition to the friction of a fit.
std::string_view BesideFriction(const Fit& fit) {
  if (fit.RowOf(Role::scale)) {
    return "are description, torque and sign those of the log, does its motor ripple (--gear N)?";
  }
  return fit.model.gravity ? "do other joints move, or is a sign or a unit wrong?"
                           : "is there gravity (--gravity sincos), or a wrong sign or unit?";
}

/// "inertia is -0.1 kg.m^2, below 0 with its whole 95 % interval, -0.2 to -0.05"
std::string BelowZero(const Unknown& inertia, const std::array<double, 2>& interval95) {
  return fmt::format("inertia is {:.3g} {}, below 0 with its whole 95 % interval, {:.3g} to {:.3g}",
                     inertia.value, inertia.unit, interval95[0], interval95[1]);
}

}  // namespace

std::string ExplainDriving(double time, std::string_view remedy) {
  return fmt::format("at {:.6g} s the fitted friction drives the joint instead of braking it; {}",
                     time, remedy);
}

std::string RemedyForNonDissipative(std::string_view law, FittedGravity gravity) {
  const bool none = gravity == FittedGravity::none;
  // levels of their own for both directions
  const IdentifyCommand levels = IdentifyCommand{"energy-ml"}.With("law", Asymmetric::name);
  if (law != Asymmetric::name) {
    return Remedy{"", none ? levels : levels.With("gravity", NameOf(gravity))}.Text();
  }
  if (none) {
    return Remedy{"does the torque hold gravity or another load? ",
                  levels.With("gravity", NameOf(FittedGravity::paired))}
        .Text();
  }

  // both are fitted already: the remaining cause is the sign
  return "is the sign of the torque reversed (--scale torque=-1)?";
}

std::string ExplainWorseThanMean(double fit_share, const Fit& fit) {
  return fmt::format(
      "the torque's mean follows it better than the friction does (Fit {:.3g} %): {}", fit_share,
      BesideFriction(fit));
}

std::string ExplainPoorFit(double fit_share, double least, const Fit& fit) {
  return fmt::format(
      "the fit explains little of the torque (Fit {:.3g} %, of {:.0f} % at least): {}", fit_share,
      least, BesideFriction(fit));
}

std::string ExplainWorseHeldOut(double with, double without, const Fit& fit) {
  return fmt::format(
      "of the last part of the log, a fit to the first leaves {:.3g} with its friction and {:.3g} "
      "without: the joint changed, or it is not friction; {}",
      with, without, BesideFriction(fit));
}

std::string ExplainMuchLeft(double left, double friction, const Fit& fit) {
  return fmt::format(
      "the fit leaves {:.3g} of the torque (rms), more than half of the friction that it finds, "
      "{:.3g}: {}",
      left, friction, BesideFriction(fit));
}

std::string ExplainNoFriction(double share) {
  return fmt::format(
      "this torque holds no friction: what was fitted is {:.2g} % of it. A sensor behind the gear "
      "and the torque of a model show none; log that of the motor, or its current",
      100 * share);
}

std::string ExplainNegativeInertia(const Unknown& inertia,
                                   const std::array<double, 2>& interval95) {
  return fmt::format(
      "{}, and there is no fit without it: the torque is late or early against the "
      "motion, or another load acts",
      BelowZero(inertia, interval95));
}

std::string ExplainHeldInertia(const Unknown& inertia, const std::array<double, 2>& interval95,
                               double share) {
  return fmt::format(
      "{}: it was fitted as 0, and intervals cover by how much that changes the friction, {:.2g} % "
      "(rms)",
      BelowZero(inertia, interval95), 100 * share);
}

std::string ExplainInertiaMatters(std::string_view held, double relevance, TorqueSign sign) {
  return fmt::format(
      "{}, of {:.3g} % at most (--relevance): the torque is late or early "
      "against the motion{}, or another load acts",
      held, 100 * relevance,
      sign == TorqueSign::doubtful ? ", has the wrong sign (--scale torque=-1)" : "");
}

std::string NameOfFriction(const FrictionAtSpeed& at) {
  std::string name = fmt::format("friction {} at {:.3g}", at.speed < 0 ? "backwards" : "forwards",
                                 std::abs(at.speed));
  if (!at.speed_unit.empty()) name += " " + at.speed_unit;
  if (at.energy) name += *at.energy == 0 ? ", cold" : ", warm";
  return name;
}

std::string ExplainUnknownFriction(const std::vector<FrictionAtSpeed>& all) {
  const FrictionAtSpeed& one = all[all.size() / 2];
  return fmt::format(
      "the friction is known to worse than itself at every speed of the log ({} is {:.2g} {}, its "
      "95 % interval {:.2g} to {:.2g}): record longer, at steadier speeds in both directions",
      NameOfFriction(one), one.value, one.unit, one.interval95[0], one.interval95[1]);
}

std::string ExplainLeftOutSpeeds(const std::vector<FrictionAtSpeed>& left_out) {
  std::vector<std::string> names;
  for (const FrictionAtSpeed& one : left_out) names.push_back(NameOfFriction(one));
  return fmt::format("left out, since it is known to worse than itself: {}",
                     fmt::join(names, "; "));
}

std::string ExplainOwnLaw(const MovedParameter& moved) {
  return fmt::format(
      "the estimate does not fit its log: the same law fits it better with {} changed by {:.3g} "
      "{}; fit again, and check units, signs and the samples that were used",
      moved.parameter.name, moved.change, moved.parameter.unit);
}

std::string ExplainTorqueOverTime(double share) {
  return fmt::format(
      "the torque changes over time by {:.2g} of the friction, which this joint's motion does not "
      "explain; another joint may move: "
      "keep the others still, or identify the whole robot with `warmjoint identify-robot`",
      share);
}

std::string ExplainDriftOfFriction(double share, double most) {
  return fmt::format(
      "the friction changes over the log by {:.2g} % (rms), more than {:.0f} %, which no law "
      "without a warming has; try "
      "--identifier energy-ml on a log from a cold start, or record once the joint has settled",
      100 * share, 100 * most);
}

}  // namespace warmjoint
