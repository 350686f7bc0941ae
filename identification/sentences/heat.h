// Of heat: the start, gaps, and a warming that the log does not show.
#pragma once

#include <warmjoint/recording.h>

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "identification/inference/cause.h"
#include "identification/sentences/moved_parameter.h"

namespace warmjoint {

inline constexpr const char* kOthersBeginCold =
    "what is expected of E(0) is taken for the first recording, and the others are taken to begin "
    "cold; use --start estimated if they did not";
/// Of a start that is not known.
inline constexpr const char* kCoversWarmStart =
    "the intervals also cover a start at a tenth of the warmth that the joint reaches";
/// Of a start that was taken to be cold: what a warm one would change. begins: first time of the log, s
std::string ExplainColdStart(const MovedParameter& moved, double begins, std::string_view remedy);
/// Of a log that contradicts what was expected of E(0), with its standard deviation, N.m or N.
std::string ExplainUnexpectedStart(double found, double expected, double deviation);

/// Of losses that may follow the heat within a step of the log, s. change: of thermal_time_constant, s, which has it (shift)
/// or an interval that covers it
std::string ExplainHeldLosses(double step, double change, Action action);
/// Of gaps in the log whose losses are estimated, or which intervals cover (widen). time: [N] s
std::string ExplainGaps(const std::vector<LogGap>& gaps, const Eigen::VectorXd& time,
                        Action action);

// of a first guess by the torque's envelope that cannot be made
inline constexpr const char* kRestsTooSoon =
    "the joint moves too briefly before its first long rest to guess how it warms; give start_gain "
    "and start_time_constant";
inline constexpr const char* kHeatsItself =
    "friction grows with its own losses faster than it settles; give start_gain and "
    "start_time_constant";
/// Of a level that changes within its noise, N.m or N.
std::string ExplainLevelInNoise(double change, double noise);
/// Of one that is still so far, N.m or N, from that of the quarter before, after a change by so much.
std::string ExplainUnsettledLevel(double still, double change);

/// Of a log that shows no warming: by how much it lowers the squared residuals, in variances of the noise, where `needed` count. beside: what
/// the fit has with it, "" or words that begin with a blank; instead: the identifier that fits without
std::string ExplainUnseenWarming(double lowers, double needed, std::string_view beside,
                                 std::string_view instead);
/// Of a warming that is faster than heat, s.
std::string ExplainFastWarming(double time_constant, double fastest, std::string_view instead);
/// Of gain and time constant that trade off: since the latter, in s, lies outside of what the log can show, since it is known to a factor,
/// or not at all; and since it is longer than the log's duration, s, by far.
std::string ExplainHiddenTimeConstant(double time_constant, double shortest, double longest);
std::string ExplainVagueTimeConstant(double factor);
std::string ExplainUnknownTimeConstant();
std::string ExplainRunawayTimeConstant(double duration);
/// Of a time constant, s, at the end of those that the samples can show, and of columns of the warming that the law has, too.
std::string ExplainLongestTimeConstant(double time_constant);
inline constexpr const char* kWarmingIsMixed =
    "the motion does not distinguish warming from the nominal friction; record from cold, with "
    "speeds that differ clearly, until the friction settles";

}  // namespace warmjoint
