#include "tools/cli/robot_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "models/foundation/excerpt.h"
#include "tools/shown/shown_estimate.h"

namespace warmjoint {
namespace {

constexpr int kVerdictsWidth = 100;  // columns

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

/// Verdict, and what the friction may be used for.
std::string Verdict(const RobotJointEstimate& one) {
  const std::string verdict(NameOf(one.estimate.status));
  if (one.estimate.status != Status::ok) return verdict;
  return verdict + (one.HasFriction() ? ": attach" : ": in A");
}

/// The cold friction in one direction at the speeds that the answer has, the slowest first.
std::vector<std::string> AtSpeeds(const Estimate& estimate, double direction) {
  std::vector<FrictionAtSpeed> cold;
  for (const FrictionAtSpeed& one : estimate.friction_at_speeds) {
    if (one.speed * direction > 0 && one.energy.value_or(0) == 0) cold.push_back(one);
  }
  std::ranges::sort(cold, {}, [](const FrictionAtSpeed& one) { return std::abs(one.speed); });
  std::vector<std::string> cells(3, "-");
  for (std::size_t i = 0; i < std::min(cells.size(), cold.size()); ++i) {
    const auto& [lower, upper] = cold[i].interval95;
    cells[i] = fmt::format("{:.3g} +-{:.1g}", cold[i].value, (upper - lower) / 2);
  }
  return cells;
}

/// "load 0.054", of a friction that grows with what the joint carries.
std::string LoadText(const Estimate& estimate) {
  const EstimatedParameter* const load = estimate.Find("load_gain");
  return load && load->value > 0 ? fmt::format("load {:.2g}", load->value) : "";
}

/// Two lines a joint, one for each direction.
Table VerdictsOf(const RobotEstimate& robot) {
  Table table{{"joint", "verdict", "", "slow", "middle", "fast", "warming, load"}, {}};
  for (const RobotJointEstimate& one : robot.joints) {
    const Estimate& e = one.estimate;
    const std::string& unit = one.summary.torque_unit;
    std::vector<std::string> forwards{one.summary.joint, Verdict(one), "+ " + unit};
    std::ranges::copy(AtSpeeds(e, 1), std::back_inserter(forwards));
    forwards.push_back(e.parameters.empty() ? "-" : WarmingText(e));
    table.rows.push_back(forwards);
    if (e.friction_at_speeds.empty()) continue;
    std::vector<std::string> backwards{"", "", "- " + unit};
    std::ranges::copy(AtSpeeds(e, -1), std::back_inserter(backwards));
    backwards.push_back(LoadText(e));
    table.rows.push_back(backwards);
  }
  return table;
}

Table ParametersOf(const RobotEstimate& robot) {
  Table table{{"joint", "viscous", "Coulomb +", "Coulomb -", "their mean", "offset", "load", "gain",
               "held-out rms", "all that moves", "no friction"},
              {}};
  for (const RobotJointEstimate& one : robot.joints) {
    const Estimate& e = one.estimate;
    const RobotJointSummary& s = one.summary;
    table.rows.push_back(
        {s.joint, Shown(e, "viscous"), Shown(e, "coulomb_positive"), Shown(e, "coulomb_negative"),
         Shown(e, "coulomb"), Shown(e, kTorqueOffset), Shown(e, "load_gain"), Gain(s),
         Number(s.rms_held_out), Number(s.rms_moving), Number(s.rms_without_friction)});
  }
  return table;
}

}  // namespace

std::string RobotToText(const RobotEstimate& robot, const Page& page) {
  // what is no terminal has room for the verdicts of a joint in one line
  Page wide = page;
  if (!page.terminal) wide.width = std::max(page.width, kVerdictsWidth);
  std::string text = TableToText(VerdictsOf(robot), 3, wide);
  for (const RobotJointEstimate& one : robot.joints) {
    const Colour colour = one.estimate.status == Status::ok ? Colour::green : Colour::yellow;
    text += fmt::format("{}: {}\n", Paint(Printable(one.summary.joint), colour, page),
                        Printable(one.estimate.FullMessage()));
  }
  return text + "\n" + TableToText(ParametersOf(robot), 1, wide);
}

}  // namespace warmjoint
