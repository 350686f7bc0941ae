#include "identification/warming/warming_verdict.h"

#include <fmt/format.h>

#include <cmath>

namespace warmjoint {

namespace {

constexpr double kNotAtAll = 100;  // a factor within which nothing is known

/// What a fit knows of tau, where that is too little.
std::string WhatIsKnown(const WarmingEvidence& evidence) {
  const double tau = evidence.time_constant;
  const double factor = std::exp(1.96 * evidence.log_deviation);
  if (!(factor < kNotAtAll)) return "nothing is known of tau";
  if (tau < evidence.shortest / 4 || tau > evidence.longest * 4) {
    return fmt::format("tau is {:.3g} s, and the log can show {:.3g} to {:.3g} s", tau,
                       evidence.shortest, evidence.longest);
  }
  return fmt::format("tau is known to a factor of {:.3g} only", factor);
}

}  // namespace

std::optional<std::string> InsignificantWarming(double explained, const WarmingContext& context) {
  if (explained > kVisibleWarming) return std::nullopt;
  return fmt::format(
      "no warm-up can be seen{}: warming lowers the sum of squared residuals by {:.3g} noise "
      "variances, and {:.3g} are needed; {} fits without warming, and a drift that it shows here "
      "does not come from the losses; to see a warm-up, record ten minutes or more from cold",
      context.beside, explained > 0 ? explained : 0.0, kVisibleWarming, context.instead);
}

std::optional<std::string> UnidentifiableWarming(const WarmingEvidence& evidence,
                                                 const WarmingContext& context) {
  if (auto why = InsignificantWarming(evidence.explained, context)) return why;
  const double tau = evidence.time_constant;
  if (tau < FastestWarming(evidence.step)) {
    return fmt::format(
        "what looks like warming has a time constant of {:.2g} s, and nothing warms within {:.2g} "
        "s: is the torque or the velocity late or filtered? {} fits without warming",
        tau, FastestWarming(evidence.step), context.instead);
  }
  // a time constant that may be longer than the log must be known better
  const bool beyond = tau * std::exp(1.96 * evidence.log_deviation) > evidence.duration;
  if (evidence.log_deviation < (beyond ? kImpreciseLongLogTau : kImpreciseLogTau) &&
      tau >= evidence.shortest / 4 && tau <= evidence.longest * 4) {
    return std::nullopt;
  }
  if (auto why = RunawayWarming(tau, evidence.duration)) return why;
  return fmt::format(
      "thermal_gain and thermal_time_constant cannot be told apart: {}; record longer, from cold "
      "until friction settles, or with rests",
      WhatIsKnown(evidence));
}

std::optional<std::string> RunawayWarming(double time_constant, double duration) {
  if (!(time_constant > 5 * duration)) return std::nullopt;
  return fmt::format(
      "thermal_gain and thermal_time_constant cannot be told apart: the friction still changes at "
      "the same rate at the end of the {:.4g} s, so that any longer tau fits as well; record "
      "longer, from cold until friction settles, or with rests",
      duration);
}

}  // namespace warmjoint
