// Of laws whose friction falls with speed, Stribeck's and LuGre.
#pragma once

#include <warmjoint/friction.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>

#include "identification/sentences/fit.h"

namespace warmjoint {

/// The remedy where slow speeds are missing. slowest: constant speed of the log, aim: one to record, rad/s or m/s
std::string ExplainSlowSpeeds(double slowest, double aim, JointKind joint);

/// The sentence about a fall from the level at rest that no scan finds. rest: name of that level's parameter
std::string ExplainNoFall(std::string_view rest, std::string_view remedy);
/// The sentence about a fall that is not seen. lowers: by how much it lowers the squared residuals, in variances of the noise;
/// needed: from which value on a fall counts as seen
std::string ExplainUnseenFall(std::string_view rest, double lowers, double needed,
                              std::string_view remedy);
/// The sentence about a fall that is too small. errors: its size in standard errors; needed: from which value on it counts;
/// fall: its name in words
std::string ExplainSmallFall(std::string_view fall, double errors, double needed,
                             std::string_view remedy);

/// A fall that the log shows but does not determine well.
struct VagueFall {
  std::string_view rest;       // name of the level's parameter
  std::string_view fall;       // in words
  double half_width = 0;       // of the fall's 95 % interval, N.m or N
  double velocity_factor = 0;  // to which stribeck_velocity is known
};
/// The sentence about such a fall, and the remedy.
std::string ExplainVagueFall(const VagueFall& known, std::string_view remedy);

/// The sentence about a bristle whose stiffness the reversals do not determine, or determine only to a factor.
std::string ExplainUnknownStiffness();
std::string ExplainVagueStiffness(double factor);

/// A bristle's damping that the log does not determine.
struct UnknownDamping {
  double value = 0, deviation = 0;  // N.m.s/rad or N.s/m
  double bend = 0;                  // how far the bristle bends, rad or m
};
/// The sentence about such a damping, and how to reverse to determine it.
std::string ExplainUnknownDamping(const UnknownDamping& damping, JointKind joint);

/// The sentence about a law that does not describe the friction at turns. The arguments are residuals, rms in `unit`.
std::string ExplainTurns(double at_turns, double at_constant_speeds, const std::string& unit);

/// What was done: a clause. exponent: of the law, given
std::string SummaryOfFall(const FittedSamples& samples, double exponent);

/// Samples of a fit around reversals, and what it leaves of them and of the others.
struct AroundReversals {
  Eigen::Index samples = 0;
  double residual = 0, elsewhere = 0;  // rms, in the torque's unit
};
/// The same of a law with a bristle. turns: none where all samples hold a speed
std::string SummaryOfBristle(const FittedSamples& samples,
                             const std::optional<AroundReversals>& turns, const std::string& unit);

}  // namespace warmjoint
