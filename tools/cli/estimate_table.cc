#include "tools/cli/estimate_table.h"

#include <fmt/ranges.h>
#include <warmjoint/score.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>

#include "identification/gravity.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/serialize.h"
#include "tools/shown/shown_estimate.h"

namespace warmjoint {
namespace {

std::string Interval(const std::array<double, 2>& interval) {
  return fmt::format("{:.5g} .. {:.5g}", interval[0], interval[1]);
}

Table ParameterTable(const Estimate& estimate) {
  const std::string heading = estimate.status == Status::ok ? "parameter" : "void parameter";
  Table table{{heading, "value", "unit", "std", "95 % interval"}, {}};
  // what is not known is a dash
  for (const EstimatedParameter& one : ShownParameters(estimate)) {
    // of a value at its bound the range is all that is known
    const std::optional<std::string> range = RangeAtBound(one);
    table.rows.push_back({one.name, range.value_or(fmt::format("{:.6g}", one.value)), one.unit,
                          one.std && !range ? fmt::format("{:.2g}", *one.std) : "-",
                          one.interval95 ? Interval(*one.interval95) : "-"});
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
  // a figure that does not exist is a dash
  if (!metrics) return;
  table.rows.push_back({name, std::to_string(metrics->n), fmt::format("{:.4g}", metrics->rmse),
                        fmt::format("{:.4g}", metrics->mae),
                        std::isfinite(metrics->fit) ? fmt::format("{:.2f}", metrics->fit) : "-",
                        std::isfinite(metrics->fpe) ? fmt::format("{:.4g}", metrics->fpe) : "-"});
}

std::string RemarksText(const Estimate& estimate, Detail detail) {
  const std::vector<std::string> all = Remarks(estimate);
  // the first few, or all of them
  const std::vector<std::string> shown = detail == Detail::full ? all : BriefRemarks(estimate);
  std::string text;
  for (const std::string& remark : shown) text += fmt::format("  {}\n", Printable(remark));
  if (detail == Detail::brief && shown != all) text += "  --explain tells more.\n";
  return text;
}

/// The tests that were made, and below them those that were not, by what they lack.
std::string TestsText(const Estimate& estimate, const Page& page) {
  Table table{{"test for lack of fit", "verdict", "finding", "p of all", "effect"}, {}};
  std::map<std::string, std::vector<std::string>> not_made;
  for (const Diagnostic& one : estimate.diagnostics) {
    if (!one.made) {
      not_made[one.reason].push_back(one.test);
      continue;
    }
    table.rows.push_back({one.test, one.rejected ? "lack of fit" : "passed", one.reason,
                          fmt::format("{:.2g}", one.p_adjusted),
                          fmt::format("{:.2g} {}", one.effect, one.effect_unit)});
  }
  std::string text;
  if (!table.rows.empty()) text += "\n" + TableToText(table, 3, page);
  if (!not_made.empty()) text += "\ntests that were not made\n";
  for (const auto& [reason, tests] : not_made) {
    text += fmt::format("  {}: {}\n", fmt::join(tests, ", "), Printable(reason));
  }
  return text;
}

/// The structures that were tried.
Table TrialTable(const StructureChoice& choice, const std::string& unit) {
  Table table{{"structure", "remark", "parameters"}, {}};
  // which was chosen, and why others were no contenders
  for (const StructureTrial& one : choice.trials) {
    table.rows.push_back({one.name, one.name == choice.chosen ? "chosen" : one.dropped,
                          one.parameters > 0 ? fmt::format("{:.3g}", one.parameters) : "-"});
  }
  // their errors, where blocks were needed to choose
  if (std::ranges::none_of(choice.trials, [](const auto& one) { return one.rmse.has_value(); })) {
    return table;
  }
  table.header.push_back(fmt::format("held-out RMSE {}", unit));
  for (size_t i = 0; i < choice.trials.size(); ++i) {
    const std::optional<double>& rmse = choice.trials[i].rmse;
    table.rows[i].push_back(rmse ? fmt::format("{:.4g}", *rmse) : "-");
  }
  return table;
}

/// What was assumed, and what each parameter would do were it off by that much.
std::string AssumptionsText(const Estimate& estimate) {
  std::string text;
  // each with the parameters that it would move
  for (const Assumption& one : ShownAssumptions(estimate)) {
    std::vector<std::string> moves;
    for (const auto& [name, change] : one.moves) {
      if (change != 0) moves.push_back(fmt::format("{} by {:.2g}", name, change));
    }
    if (moves.empty()) moves.emplace_back("nothing");
    text +=
        fmt::format("  {}: {}; else it moves {}\n", one.name, one.meaning, fmt::join(moves, ", "));
  }
  return text.empty() ? "" : "\nassumptions\n" + text;
}

/// The half width of each interval with its parts, the largest first.
Table HalfWidthTable(const Estimate& estimate) {
  Table table{{"95 % interval of", "made of", "half width"}, {}};
  std::vector<std::string> order;
  std::map<std::string, std::vector<HalfWidthPart>> parts;
  for (const HalfWidthPart& part : estimate.half_widths) {
    if (!parts.contains(part.parameter)) order.push_back(part.parameter);
    parts[part.parameter].push_back(part);
  }
  for (const std::string& name : order) {
    std::vector<HalfWidthPart>& of = parts[name];
    std::ranges::stable_sort(of, std::greater(), &HalfWidthPart::half_width);
    double all = 0;
    for (const HalfWidthPart& part : of) all += part.half_width;
    // why 0.005: what is smaller changes none of the two digits of the whole
    std::vector<std::string> words;
    for (const HalfWidthPart& part : of) {
      if (part.half_width < 0.005 * all) continue;
      words.push_back(fmt::format("{} {:.2g}", part.by, part.half_width));
    }
    table.rows.push_back(
        {name, fmt::format("{}", fmt::join(words, ", ")), fmt::format("{:.2g}", all)});
  }
  return table;
}

/// What intervals are made of, every test for lack of fit and every assumption.
std::string Explanation(const Estimate& estimate, const Page& page) {
  const Table widths = HalfWidthTable(estimate);
  const std::string text = widths.rows.empty() ? "" : "\n" + TableToText(widths, 2, page);
  return text + TestsText(estimate, page) + AssumptionsText(estimate);
}

Colour ColourOf(Status status) {
  if (status == Status::ok) return Colour::green;
  return status == Status::bad_data ? Colour::red : Colour::yellow;
}

/// digits: of numbers.
Table ComparisonTable(const std::vector<ParameterScore>& parameters, int digits) {
  Table table{{"parameter", "estimate", "lower95", "upper95", "truth", "in interval", "error %"},
              {}};
  const auto cell = [digits](const std::optional<double>& value) {
    return value ? fmt::format("{:.{}g}", *value, digits) : "-";
  };
  // what is not known is a dash
  for (const ParameterScore& one : parameters) {
    const std::string inside = !one.covered ? "-" : *one.covered ? "yes" : "no";
    table.rows.push_back({one.name, one.estimated ? cell(one.estimate) : "-",
                          one.interval95 ? cell((*one.interval95)[0]) : "-",
                          one.interval95 ? cell((*one.interval95)[1]) : "-", cell(one.truth),
                          inside, one.relative_error ? cell(100 * *one.relative_error) : "-"});
  }
  return table;
}

}  // namespace

std::string FormatCompared(const Estimate& estimate, const Friction& truth,
                           const std::string& format) {
  const std::vector<ParameterScore> parameters = ScoreParameters(estimate, truth);
  const double npe = ParameterError(parameters);
  if (format == "json") {
    Tree json{
        {"identifier", estimate.identifier}, {"status", StatusName(estimate.status)}, {"npe", npe}};
    for (const ParameterScore& one : parameters) json["parameters"][one.name] = WriteFields(one);
    return json.dump(2) + "\n";
  }
  const Table table = ComparisonTable(parameters, format == "csv" ? 15 : 6);
  if (format == "csv") {
    std::string csv = fmt::format("{}\n", fmt::join(table.header, ","));
    for (const auto& row : table.rows) csv += fmt::format("{}\n", fmt::join(row, ","));
    return csv;
  }
  return fmt::format(
      "{}: {}. NPE {:.3g} %: the relative error over all parameters of the truth, Eq. (26) of the "
      "paper.\n\n{}",
      Printable(estimate.identifier), StatusName(estimate.status), 100 * npe,
      format == "text" ? TableToText(table, 1, PageOf(stdout)) : TableToMarkdown(table, 1));
}

std::string EstimateToText(const Estimate& estimate, const Measurements& measurements,
                           const Page& page, Detail detail) {
  // the verdict, and what led to it
  std::string text =
      fmt::format("{}: {}\n", Printable(estimate.identifier),
                  Paint(StatusName(estimate.status), ColourOf(estimate.status), page));
  // a choice whose winner failed still says why it was chosen
  if (estimate.choice && estimate.status != Status::ok && !estimate.choice->chosen.empty()) {
    text += fmt::format("  {}\n", Printable(estimate.choice->reason));
  }
  text += RemarksText(estimate, detail);
  // numbers, void or not
  if (!estimate.parameters.empty())
    text += fmt::format("\n{}", TableToText(ParameterTable(estimate), 1, page));

  const std::string& unit = measurements.torque_unit;
  if (estimate.gravity && estimate.gravity->kind == GravityKind::paired) {
    text += PairedGravity(*estimate.gravity, unit);
  }

  // how well it fits what it has seen and what it has not
  Table table{{"fit", "samples", fmt::format("RMSE {}", unit), fmt::format("MAE {}", unit), "Fit %",
               fmt::format("FPE ({})^2", unit)},
              {}};
  AddMetrics(table, "all data", estimate.metrics);
  AddMetrics(table, "held out", estimate.holdout);
  if (!table.rows.empty()) text += fmt::format("\n{}", TableToText(table, 1, page));
  if (!estimate.without_holdout.empty()) {
    text += fmt::format("\nno held-out figures: {}\n", Printable(estimate.without_holdout));
  }
  // all that the verdict rests on
  if (detail == Detail::full && estimate.choice) {
    text += "\n" + TableToText(TrialTable(*estimate.choice, unit), 2, page);
  }
  if (detail == Detail::full) text += Explanation(estimate, page);
  return text;
}

std::string EstimatesToText(const std::vector<Answered>& answers, const std::string& unit,
                            const Page& page) {
  Table table{{"identifier", "verdict", "RMSE " + unit, "held-out RMSE"}, {}};
  // a column for each parameter that one of them has
  std::vector<std::string> names;
  for (const Answered& answer : answers) {
    if (!answer.identified) continue;
    for (const EstimatedParameter& one : OwnParameters(answer.identified->estimate)) {
      if (std::ranges::find(names, one.name) != names.end()) continue;
      names.push_back(one.name);
      table.header.push_back(one.unit == "1" ? one.name : one.name + " " + one.unit);
    }
  }

  // what one does not have is a dash
  for (const Answered& answer : answers) {
    std::vector<std::string>& cells =
        table.rows.emplace_back(std::vector<std::string>(table.header.size(), "-"));
    cells[0] = answer.name;
    cells[1] = answer.status;
    if (!answer.identified) continue;
    const Estimate& estimate = answer.identified->estimate;
    cells[1] = StatusName(estimate.status);
    if (estimate.metrics) cells[2] = fmt::format("{:.4g}", estimate.metrics->rmse);
    if (estimate.holdout) cells[3] = fmt::format("{:.4g}", estimate.holdout->rmse);
    for (const EstimatedParameter& one : OwnParameters(estimate)) {
      const auto column = std::ranges::find(names, one.name) - names.begin();
      cells[4 + static_cast<size_t>(column)] =
          RangeAtBound(one).value_or(fmt::format("{:.4g}", one.value));
    }
  }
  return TableToText(table, 2, page);
}

}  // namespace warmjoint
