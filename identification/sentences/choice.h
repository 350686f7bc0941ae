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
/// Of one that warms, in a log that lasts so long, s.
std::string ExplainShortLog(double duration);

// why one that was tried is dropped
inline constexpr const char* kGivesNoFriction = "gives no friction";
inline constexpr const char* kFailsWithoutBlock = "fails without one of the blocks";
/// Of one without slope, where another has it.
std::string ExplainMissingSlope(std::string_view sloped);
/// Of one that a simpler one outdoes, and of one that leaves far more than another.
std::string ExplainOutdone(std::string_view simpler);
std::string ExplainHopeless(std::string_view better);

/// A structure, and its error on blocks that it has not seen, rms in the torque's unit.
struct ComparedStructure {
  std::string_view name;
  double rmse = 0;
};
/// Why the chosen one: of the smallest error, or simpler than that and not significantly worse. unit: of the torque
std::string ExplainSmallestError(const ComparedStructure& chosen, std::string_view unit,
                                 int blocks);
std::string ExplainSimplest(const ComparedStructure& chosen, const ComparedStructure& best,
                            std::string_view unit, int blocks);
/// Of the only one that stands, and of one that was chosen by BIC.
std::string ExplainOnlyOne(std::string_view chosen);
std::string ExplainChosenByBic(std::string_view chosen, int blocks);
/// Of so many that were tried, and none of them fits. why: the message of the first
std::string ExplainNothingFits(std::size_t tried, std::string_view first, std::string_view why);

/// What the motion does not show, each a clause and a semicolon. why: of `check`
std::string ExplainUnseenSlope(std::string_view why);
std::string ExplainUnseenWarmUp(std::string_view why);
/// What was done: those clauses, why the chosen one, and what its fit says.
std::string SummaryOfChoice(std::string_view not_shown, std::string_view reason,
                            std::string_view summary);

}  // namespace warmjoint
