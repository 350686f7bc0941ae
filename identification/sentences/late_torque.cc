#include "identification/sentences/late_torque.h"

#include <fmt/format.h>

#include <cmath>

namespace warmjoint {
namespace {

/// "the torque comes 20 ms (2 samples) late against the positions"
std::string DescribeDelay(double delay, double step, std::string_view comes = "comes") {
  return fmt::format("the torque {} {:.3g} ms ({:.2g} samples) {} against the positions", comes,
                     1e3 * std::abs(delay), std::abs(delay) / step, delay < 0 ? "early" : "late");
}

}  // namespace

std::string ExplainDelay(double delay, double step) {
  return DescribeDelay(delay, step) + ", which the fit takes into account";
}

std::string ExplainUntoldDelay(double delay, double step) {
  return DescribeDelay(delay, step, "may come") +
         ", which this log does not tell: the intervals reach as far as that moves the values; log "
         "faster, or swing a known weight";
}

std::string ExplainDelayLeftOut(double delay, double step, double harm,
                                std::string_view identifier) {
  return fmt::format(
      "{}, which changes the friction by {:.2g} % and which {} does not take into account: try "
      "--identifier nominal-ls, or shift the torque in the file",
      DescribeDelay(delay, step), 100 * harm, identifier);
}

std::string ExplainLeftOutByLag(double lag) {
  return fmt::format(
      "the torque lags by {:.3g} s: samples within five times that after a change of speed are "
      "left out",
      lag);
}

std::string ExplainSettling(double settling) {
  return fmt::format(
      "the torque takes {:.2g} s to settle after a change of speed: the samples until then are "
      "left out",
      settling);
}

}  // namespace warmjoint
