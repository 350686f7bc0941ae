// Of the structure that `auto` chose among those that it tried, and of why it dropped the others.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace warmjoint {

// why a structure is left out
inline constexpr const char* kNoGravityNorWarming =
    "neither gravity nor a warming can be seen by itself";
inline constexpr const char* kTakesColdStartAlone = "it takes the joint for cold as the log begins";
inline constexpr const char* kNoBendNorWarming =
    "neither a bend over the speed nor a warming can be seen by itself";
inline constexpr const char* kNothingOverPlace = "nothing is left over place that a map could take";
/// The sentence about a structure with warming, in a log that is too short for it. duration: of the log, s
std::string ExplainShortLog(double duration);

// why one that was tried is dropped
inline constexpr const char* kGivesNoFriction = "gives no friction";
inline constexpr const char* kBeyondBoundsOnAll =
    "on every sample its friction would drive the joint";
inline constexpr const char* kFailsWithoutBlock = "fails without one of the blocks";
/// The sentence about a structure without a slope over speed, where the same structure with a slope was fitted. sloped: its name
std::string ExplainMissingSlope(std::string_view sloped);
/// The sentence about a structure to which a simpler one is preferred; the next is about one that leaves far more than another.
std::string ExplainOutdone(std::string_view simpler);
std::string ExplainHopeless(std::string_view better);

/// A structure, and its error on blocks that it has not seen, rms in the torque's unit.
struct ComparedStructure {
  std::string_view name;
  double rmse = 0;
};
/// Why a structure was chosen: it has the smallest error, or it is simpler and not significantly worse. unit: of the torque
std::string ExplainSmallestError(const ComparedStructure& chosen, std::string_view unit,
                                 int blocks);
std::string ExplainSimplest(const ComparedStructure& chosen, const ComparedStructure& best,
                            std::string_view unit, int blocks);
inline constexpr const char* kFollowsTemperature =
    "friction follows the measured temperature, which is likelier than the heat of its losses";
/// The sentence about the only structure that is not dropped; the next is about one that was chosen by BIC.
std::string ExplainOnlyOne(std::string_view chosen);
std::string ExplainChosenByBic(std::string_view chosen, int blocks);
/// The sentence about a log that none of the structures fits. tried: their number; why: the message of the first
std::string ExplainNothingFits(std::size_t tried, std::string_view first, std::string_view why);

/// What the motion does not show, each a clause and a semicolon. why: of `check`
std::string ExplainUnseenSlope(std::string_view why);
std::string ExplainUnseenWarmUp(std::string_view why);
/// The summary of the choice: those clauses, the reason for the chosen structure, and the summary of its fit.
std::string SummaryOfChoice(std::string_view not_shown, std::string_view reason,
                            std::string_view summary);

}  // namespace warmjoint
