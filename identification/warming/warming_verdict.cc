#include "identification/warming/warming_verdict.h"

#include <cmath>

#include "identification/sentences/heat.h"

namespace warmjoint {

namespace {

// factor of the time constant's interval from which on it counts as unknown
constexpr double kNotAtAll = 100;

/// Why a fit determines tau too poorly.
std::string WhyUntold(const WarmingEvidence& evidence) {
  const double tau = evidence.time_constant;
  const double factor = std::exp(1.96 * evidence.log_deviation);
  if (!(factor < kNotAtAll)) return ExplainUnknownTimeConstant();
  if (tau < evidence.shortest / 4 || tau > evidence.longest * 4) {
    return ExplainHiddenTimeConstant(tau, evidence.shortest, evidence.longest);
  }
  return ExplainVagueTimeConstant(factor);
}

}  // namespace

std::optional<std::string> InsignificantWarming(double explained, const WarmingContext& context) {
  if (explained > kVisibleWarming) return std::nullopt;
  return ExplainUnseenWarming(explained > 0 ? explained : 0.0, kVisibleWarming, context.beside,
                              context.instead);
}

std::optional<std::string> UnidentifiableWarming(const WarmingEvidence& evidence,
                                                 const WarmingContext& context) {
  if (auto why = InsignificantWarming(evidence.explained, context)) return why;
  const double tau = evidence.time_constant;
  if (tau < FastestWarming(evidence.step)) {
    return ExplainFastWarming(tau, FastestWarming(evidence.step), context.instead);
  }
  // a time constant that may be longer than the log must be known better
  const bool beyond = tau * std::exp(1.96 * evidence.log_deviation) > evidence.duration;
  if (evidence.log_deviation < (beyond ? kImpreciseLongLogTau : kImpreciseLogTau) &&
      tau >= evidence.shortest / 4 && tau <= evidence.longest * 4) {
    return std::nullopt;
  }
  if (auto why = RunawayWarming(tau, evidence.duration)) return why;
  return WhyUntold(evidence);
}

std::optional<std::string> RunawayWarming(double time_constant, double duration) {
  if (!(time_constant > 5 * duration)) return std::nullopt;
  return ExplainRunawayTimeConstant(duration);
}

}  // namespace warmjoint
