// Of heat: the start, gaps, and a warming that the log does not show.
#pragma once

#include <warmjoint/recording.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "identification/fit/cause.h"
#include "identification/sentences/moved_parameter.h"

namespace warmjoint {

inline constexpr const char* kOthersBeginCold =
    "what is expected of E(0) is taken for the first recording, and the others are taken to begin "
    "cold; use --start estimated if they did not";
/// The clause about a start that is not known.
inline constexpr const char* kCoversWarmStart =
    "the intervals also cover a start at a tenth of the warmth that the joint reaches";
/// The sentence about a start that was taken to be cold: what a warm one would change. begins: first time of a log whose clock ran
/// before, s
std::string ExplainColdStart(const MovedParameter& moved, std::optional<double> begins,
                             std::string_view remedy);
/// The sentence about a log that contradicts the expected E(0). All in N.m or N; deviation: the standard deviation of the expectation
std::string ExplainUnexpectedStart(double found, double expected, double deviation);

/// The sentence about losses that may follow the heat within a step of the log, s. change: of thermal_time_constant, s; action:
/// whether the value is shifted by the change, or an interval covers it
std::string ExplainHeldLosses(double step, double change, Action action);
/// The sentence about gaps in the log whose losses are estimated, or which intervals cover (widen). time: [N] s
std::string ExplainGaps(const std::vector<LogGap>& gaps, const Eigen::VectorXd& time,
                        Action action);

// of a first guess by the torque's envelope that cannot be made
inline constexpr const char* kRestsTooSoon =
    "the joint moves too briefly before its first long rest to guess how it warms; give start_gain "
    "and start_time_constant";
inline constexpr const char* kHeatsItself =
    "friction grows with its own losses faster than it settles; give start_gain and "
    "start_time_constant";
/// The sentence about a level that changes within its noise, N.m or N.
std::string ExplainLevelInNoise(double change, double noise);
/// The sentence about a level that has not settled. still: its change since the quarter before; change: its whole change; N.m or N
std::string ExplainUnsettledLevel(double still, double change);

/// The sentence about a log that shows no warming. lowers: by how much warming lowers the squared residuals, in variances of
/// the noise; needed: from which value on a warming counts as seen; beside: what the fit has besides warming, "" or words that
/// begin with a blank; instead: the identifier that fits without
std::string ExplainUnseenWarming(double lowers, double needed, std::string_view beside,
                                 std::string_view instead);
/// The sentence about a warming that is faster than heat, s.
std::string ExplainFastWarming(double time_constant, double fastest, std::string_view instead);
/// The sentences about gain and time constant that are not identifiable separately: because the time constant, s, lies outside
/// of what the log can show; because it is known only to a factor, or not at all; and because it is much longer than the log's duration, s.
std::string ExplainHiddenTimeConstant(double time_constant, double shortest, double longest);
std::string ExplainVagueTimeConstant(double factor);
std::string ExplainUnknownTimeConstant();
std::string ExplainRunawayTimeConstant(double duration);
/// The sentence about a time constant, s, at the end of those that the samples can show; the next is about columns of the
/// warming that are like those of the law.
std::string ExplainLongestTimeConstant(double time_constant);
inline constexpr const char* kWarmingIsMixed =
    "the motion does not distinguish warming from the nominal friction; record from cold, with "
    "speeds that differ clearly, until the friction settles; `warmjoint design --minutes 20 -o "
    "motion` makes such "
    "a motion";

}  // namespace warmjoint
