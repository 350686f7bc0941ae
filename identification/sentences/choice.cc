#include "identification/sentences/choice.h"

#include <fmt/format.h>

namespace warmjoint {
namespace {

std::string NameOfCompared(const ComparedStructure& chosen, std::string_view unit, int blocks) {
  return fmt::format("chose {}: RMSE {:.4g} {} on {} held-out blocks of time", chosen.name,
                     chosen.rmse, unit, blocks);
}

}  // namespace

std::string ExplainShortLog(double duration) {
  return fmt::format("a warming takes minutes to show, and the log lasts {:.3g} s", duration);
}

std::string ExplainMissingSlope(std::string_view sloped) {
  return fmt::format("{} tells the slope, with its interval", sloped);
}

std::string ExplainOutdone(std::string_view simpler) {
  return fmt::format("outdone by {}, which is simpler", simpler);
}

std::string ExplainHopeless(std::string_view better) {
  return fmt::format("{} leaves less than half of its residual", better);
}

std::string ExplainSmallestError(const ComparedStructure& chosen, std::string_view unit,
                                 int blocks) {
  return fmt::format("{}, the smallest of all", NameOfCompared(chosen, unit, blocks));
}

std::string ExplainSimplest(const ComparedStructure& chosen, const ComparedStructure& best,
                            std::string_view unit, int blocks) {
  return fmt::format("{}, simpler than {} ({:.4g}) and not significantly worse",
                     NameOfCompared(chosen, unit, blocks), best.name, best.rmse);
}

std::string ExplainOnlyOne(std::string_view chosen) {
  return fmt::format(
      "chose {}: every other structure that was tried gives no answer, leaves a larger residual, "
      "or "
      "needs more parameters for the same",
      chosen);
}

std::string ExplainChosenByBic(std::string_view chosen, int blocks) {
  return fmt::format("chose {} by BIC: none can do without one of the {} blocks of time", chosen,
                     blocks);
}

std::string ExplainNothingFits(std::size_t tried, std::string_view first, std::string_view why) {
  return fmt::format("none of {} structures fits; {} says: {}", tried, first, why);
}

std::string ExplainUnseenSlope(std::string_view why) { return fmt::format("{}; ", why); }

std::string ExplainUnseenWarmUp(std::string_view why) {
  return fmt::format("no warm-up can be seen: {}; ", why);
}

std::string SummaryOfChoice(std::string_view not_shown, std::string_view reason,
                            std::string_view summary) {
  return fmt::format("{}{}; {}", not_shown, reason, summary);
}

}  // namespace warmjoint
