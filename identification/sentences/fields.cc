#include "identification/sentences/fields.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

namespace warmjoint {
namespace {

std::string_view NameOfField(FieldKind kind) {
  switch (kind) {
    case FieldKind::place_torque:
      return "torque over the place";
    case FieldKind::place_friction:
      return "friction over the place";
    case FieldKind::speed_friction:
      return "a curve over the speed";
    case FieldKind::temperature_friction:
      return "friction over the measured temperature";
    case FieldKind::time_friction:
      return "friction over time";
    case FieldKind::time_torque:
      break;
  }
  return "torque over time";
}

}  // namespace

std::string SummaryOfFields(const std::vector<FieldShare>& shares, double left_out) {
  if (shares.empty()) return "; fields find nothing beyond that";
  std::vector<std::string> parts;
  for (const FieldShare& one : shares) {
    parts.push_back(fmt::format("{} {:.2g} %", NameOfField(one.kind), 100 * one.share));
  }
  return fmt::format(
      "; fields hold {} of the friction (rms); along this log the friction file leaves out at most "
      "{:.2g} % of the friction",
      fmt::join(parts, ", "), 100 * left_out);
}

std::string ExplainMeansOverLog(double drift) {
  return fmt::format(
      "the friction changes over the log by {:.2g} % (rms), without a warming that explains it: "
      "its "
      "figures are means over the log",
      100 * drift);
}

std::string ExplainTemperature(double slope, std::string_view torque_unit) {
  return fmt::format(
      "the friction changes with the measured temperature, by {:.2g} {}/K, rather than with the "
      "heat of its own losses: its figures are means over the log, and the friction file has no "
      "temperature",
      slope, torque_unit);
}

std::string ExplainFewFieldRows(Eigen::Index rows, Eigen::Index fewest) {
  return fmt::format(
      "no fields are fitted, since the log has {} means over 40 ms and {} are needed; record "
      "longer",
      rows, fewest);
}

}  // namespace warmjoint
