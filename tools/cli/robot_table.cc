#include "tools/cli/robot_table.h"

#include <fmt/format.h>

#include <optional>

#include "models/foundation/excerpt.h"
#include "tools/shown/shown_estimate.h"

namespace warmjoint {
namespace {

/// "0.81 +-0.02" of a parameter; a dash where there is none.
std::string Shown(const Estimate& estimate, const char* name) {
  const EstimatedParameter* one = estimate.Find(name);
  if (!one) return "-";
  if (!one->interval95) return fmt::format("{:.3g}", one->value);
  if (const auto range = RangeAtBound(*one)) return *range;
  const auto& [lower, upper] = *one->interval95;
  return fmt::format("{:.3g} +-{:.1g}", one->value, (upper - lower) / 2);
}

std::string Number(const std::optional<double>& value) {
  return value ? fmt::format("{:.3g}", *value) : "-";
}

std::string Gain(const RobotJointSummary& summary) {
  if (!summary.gain) return "-";
  return fmt::format("{:.3g}{}", *summary.gain, summary.gain_is_known ? "" : " ?");
}

std::string WarmingText(const Estimate& estimate) {
  const EstimatedParameter* const tau = estimate.Find("thermal_time_constant");
  return tau ? fmt::format("{}, {:.3g} s", Shown(estimate, "thermal_gain"), tau->value) : "none";
}

}  // namespace

std::string RobotToText(const RobotEstimate& robot, const Page& page) {
  Table table{{"joint", "verdict", "unit", "viscous", "Coulomb +", "Coulomb -", "their mean",
               "load", "gain", "warming", "held-out rms", "all that moves", "no friction"},
              {}};
  for (const RobotJointEstimate& one : robot.joints) {
    const Estimate& e = one.estimate;
    const RobotJointSummary& s = one.summary;
    table.rows.push_back(
        {s.joint, std::string(NameOf(e.status)), s.torque_unit, Shown(e, "viscous"),
         Shown(e, "coulomb_positive"), Shown(e, "coulomb_negative"), Shown(e, "coulomb"),
         Shown(e, "load_gain"), Gain(s), e.parameters.empty() ? "-" : WarmingText(e),
         Number(s.rms_held_out), Number(s.rms_moving), Number(s.rms_without_friction)});
  }
  std::string text = TableToText(table, 2, page);
  for (const RobotJointEstimate& one : robot.joints) {
    const Colour colour = one.estimate.status == Status::ok ? Colour::green : Colour::yellow;
    text += fmt::format("{}: {}\n", Paint(Printable(one.summary.joint), colour, page),
                        Printable(one.estimate.FullMessage()));
  }
  return text;
}

}  // namespace warmjoint
