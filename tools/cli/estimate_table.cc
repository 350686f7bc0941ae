#include "tools/cli/estimate_table.h"

#include <fmt/format.h>

#include "tools/board/table.h"

namespace warmjoint::inline tools {
namespace {

Table ParameterTable(const Estimate& estimate) {
  const std::string heading = estimate.status == Status::ok ? "parameter" : "void parameter";
  Table table{{heading, "value", "unit", "std", "95 % interval"}, {}};
  for (const EstimatedParameter& one : estimate.parameters) {
    table.rows.push_back({one.name, fmt::format("{:.6g}", one.value), one.unit,
                          one.std ? fmt::format("{:.2g}", *one.std) : "-",
                          one.interval95 ? fmt::format("{:.5g} .. {:.5g}", (*one.interval95)[0],
                                                       (*one.interval95)[1])
                                         : "-"});
  }
  return table;
}

/// One line on gravity that is no parameter.
std::string PairedGravity(const GravityModel& gravity, const std::string& unit) {
  const double turn = 360.0 / kGravityKnots;
  return fmt::format("\ngravity, common to both directions: {:.4g} to {:.4g} {} over {:.0f} deg\n",
                     gravity.values.minCoeff(), gravity.values.maxCoeff(), unit,
                     turn * static_cast<double>(gravity.knots.size()));
}

void AddMetrics(Table& table, const std::string& name, const std::optional<Metrics>& metrics) {
  if (!metrics) return;
  table.rows.push_back({name, std::to_string(metrics->n), fmt::format("{:.4g}", metrics->rmse),
                        fmt::format("{:.4g}", metrics->mae), fmt::format("{:.2f}", metrics->fit),
                        fmt::format("{:.4g}", metrics->fpe)});
}

}  // namespace

std::string EstimateToText(const Estimate& estimate, const Measurements& measurements) {
  std::string text = fmt::format("{}: {}", estimate.identifier, StatusName(estimate.status));
  text += estimate.FullMessage().empty() ? "\n" : fmt::format(". {}\n", estimate.FullMessage());
  if (!estimate.parameters.empty())
    text += fmt::format("\n{}", TableToText(ParameterTable(estimate), 1));

  const std::string& unit = measurements.torque_unit;
  if (estimate.gravity && estimate.gravity->kind == GravityKind::paired) {
    text += PairedGravity(*estimate.gravity, unit);
  }
  Table table{{"fit", "samples", fmt::format("RMSE {}", unit), fmt::format("MAE {}", unit), "Fit %",
               fmt::format("FPE ({})^2", unit)},
              {}};
  AddMetrics(table, "all data", estimate.metrics);
  AddMetrics(table, "held out", estimate.holdout);
  if (!table.rows.empty()) text += fmt::format("\n{}", TableToText(table, 1));
  return text;
}

}  // namespace warmjoint::inline tools
