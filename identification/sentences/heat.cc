#include "identification/sentences/heat.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace warmjoint {
namespace {

/// known: what is known of the time constant
std::string ExplainTradeOff(std::string_view known) {
  return fmt::format(
      "thermal_gain and thermal_time_constant cannot be distinguished: {}; record longer, from "
      "cold until friction settles, or with rests: `warmjoint design --for thermal_time_constant "
      "-o motion` makes such a motion",
      known);
}

}  // namespace

std::string ExplainColdStart(const MovedParameter& moved, std::optional<double> begins,
                             std::string_view remedy) {
  const std::string clock =
      begins ? fmt::format(" (its clock begins at {:.4g} s: had the joint moved before?)", *begins)
             : "";
  return fmt::format(
      "this assumes a cold start{}: had the joint been 10 % warmed up, {} would be {:.2g} {} {}; "
      "{}",
      clock, moved.parameter.name, std::abs(moved.change), moved.parameter.unit,
      moved.change < 0 ? "lower" : "higher", remedy);
}

std::string ExplainUnexpectedStart(double found, double expected, double deviation) {
  return fmt::format(
      "the log begins at a heat of {:.3g}, not at the {:.3g} +- {:.2g} that the recording before "
      "it left: E(0) is taken from this log alone; check the pause, and that the joint rested in "
      "it",
      found, expected, deviation);
}

std::string ExplainHeldLosses(double step, double change, Action action) {
  return fmt::format(
      "Eq. (22) takes the losses as constant within each step of {:.3g} s; losses that change with "
      "the heat within a step change thermal_time_constant by {:.2g} s{}",
      step, change,
      action == Action::shift ? ", and describe the log better: the numbers given are theirs"
                              : ": the intervals cover both; log faster");
}

std::string ExplainGaps(const std::vector<LogGap>& gaps, const Eigen::VectorXd& time,
                        Action action) {
  const double first = time[gaps[0].behind - 1];
  const double longest = std::ranges::max_element(gaps, {}, &LogGap::length)->length;
  const std::string where =
      gaps.size() == 1 ? fmt::format("a gap of {:.4g} s", longest)
                       : fmt::format("{} gaps of up to {:.4g} s, the first", gaps.size(), longest);
  return fmt::format("{} at {:.6g} s: the losses during that time are unknown{}", where, first,
                     action == Action::widen
                         ? ", and intervals were widened to cover this; record without gaps"
                         : " and are estimated, too");
}

std::string ExplainLevelInNoise(double change, double noise) {
  return fmt::format(
      "the friction level changes by {:.3g}, within its noise of {:.3g}: no warming to guess from; "
      "give start_gain and start_time_constant",
      change, noise);
}

std::string ExplainUnsettledLevel(double still, double change) {
  return fmt::format(
      "the friction level never settles: in the last quarter it is still {:.3g} from the quarter "
      "before, after a change of {:.3g}; record longer, or give start_gain and start_time_constant",
      still, change);
}

std::string ExplainUnseenWarming(double lowers, double needed, std::string_view beside,
                                 std::string_view instead) {
  return fmt::format(
      "no warm-up can be seen{}: warming lowers the sum of squared residuals by {:.3g} noise "
      "variances, and {:.3g} are needed; {} fits without warming, and a drift that it shows here "
      "does not come from the losses; to see a warm-up, record ten minutes or more from cold",
      beside, lowers, needed, instead);
}

std::string ExplainFastWarming(double time_constant, double fastest, std::string_view instead) {
  return fmt::format(
      "what looks like warming has a time constant of {:.2g} s, and nothing warms within {:.2g} s: "
      "is the torque or the velocity late or filtered? {} fits without warming",
      time_constant, fastest, instead);
}

std::string ExplainHiddenTimeConstant(double time_constant, double shortest, double longest) {
  return ExplainTradeOff(fmt::format("tau is {:.3g} s, and the log can show {:.3g} to {:.3g} s",
                                     time_constant, shortest, longest));
}

std::string ExplainVagueTimeConstant(double factor) {
  return ExplainTradeOff(fmt::format("tau is known to a factor of {:.3g} only", factor));
}

std::string ExplainUnknownTimeConstant() { return ExplainTradeOff("nothing is known of tau"); }

std::string ExplainRunawayTimeConstant(double duration) {
  return ExplainTradeOff(
      fmt::format("the friction still changes at the same rate at the end of the {:.4g} s, so that "
                  "any longer tau fits as well",
                  duration));
}

std::string ExplainLongestTimeConstant(double time_constant) {
  return fmt::format(
      "thermal_time_constant grows to {:.3g} s, the largest that these samples can show; record "
      "until the friction settles, or with rests",
      time_constant);
}

}  // namespace warmjoint
