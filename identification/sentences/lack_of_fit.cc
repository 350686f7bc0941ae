#include "identification/sentences/lack_of_fit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "identification/command.h"
#include "identification/sentences/remedies.h"

namespace warmjoint {

std::string ExplainFewRows(Eigen::Index rows) {
  return fmt::format("{} samples or segments are too few to examine", rows);
}

std::string ExplainNotExamined(std::string_view status) {
  return fmt::format("the fit is {}", status);
}

std::string ExplainFewRowsOfTest(Eigen::Index rows) {
  return fmt::format("{} samples or segments are too few for it", rows);
}

std::string ExplainFindings(const std::vector<FoundPart>& found, const std::string& unit,
                            std::string_view effect, std::string_view remedy) {
  std::vector<std::string> words;
  for (const FoundPart& part : found) {
    words.push_back(fmt::format(
        "{}: {:.3g} {} rms, {:.2g} % of the friction, {:.{}f} % of the residual's variance",
        part.quantity, part.rms, unit, part.of_friction, part.of_residual,
        part.of_residual < 0.95 ? 1 : 0));
  }
  return fmt::format("the residual depends on {}{}; {}", fmt::join(words, "; and on "), effect,
                     remedy);
}

std::string ExplainWeight(const std::string& identifier) {
  const IdentifyCommand command{identifier};
  return fmt::format("the torque depends on the sine of the position: {}",
                     Remedy{kActsAsWeight, command.With("gravity", "sincos")}.Text());
}

std::string ExplainTooMuch(std::string_view quantity, double harm, double relevance) {
  return fmt::format("; modelling {} would change the friction by {:.2g} % (--relevance {:.3g})",
                     quantity, 100 * harm, relevance);
}

std::string ExplainTooMuchTogether(double share, double most) {
  return fmt::format("; all of that is {:.2g} % of the friction, more than {:.2g} %", 100 * share,
                     100 * most);
}

std::string ExplainWidened(double worst, double largest) {
  return fmt::format(
      ": it changes the friction by {:.2g} % rms{}; intervals were widened to cover this",
      100 * worst,
      largest > worst ? fmt::format(", and by up to {:.2g} % at a speed", 100 * largest) : "");
}

std::string ExplainUnadjusted(const std::vector<std::string>& quantities,
                              const MovedParameter& moved, std::string_view remedy) {
  return fmt::format(
      "the residual may depend on {}: one test alone would call that found, among many it may be "
      "chance; intervals were widened to cover it, that of {} by {:.2g} {}{}",
      fmt::join(quantities, ", or on "), moved.parameter.name, moved.change, moved.parameter.unit,
      remedy);
}

}  // namespace warmjoint
