#include "identification/sentences/fields.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace warmjoint {

std::string SummaryOfFields(const std::vector<FieldShare>& shares, double left_out) {
  if (shares.empty()) return "; fields find nothing beyond that";
  std::vector<std::string> parts;
  for (const FieldShare& one : shares) {
    parts.push_back(fmt::format("{} {:.2g} %", one.name, 100 * one.share));
  }
  return fmt::format(
      "; fields hold {} of the friction (rms); along this log the friction file leaves out at most "
      "{:.2g} % of the friction",
      fmt::join(parts, ", "), 100 * left_out);
}

std::string ExplainFewFieldRows(Eigen::Index rows, Eigen::Index fewest) {
  return fmt::format(
      "no fields are fitted, since the log has {} means over 40 ms and {} are needed; record "
      "longer",
      rows, fewest);
}

}  // namespace warmjoint
