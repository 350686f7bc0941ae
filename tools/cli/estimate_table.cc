#include "tools/cli/estimate_table.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "tools/board/table.h"
#include "tools/terminal/wrap.h"

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

constexpr std::size_t kBriefly = 3;  // remarks

/// The clause as a sentence: a capital at its beginning, unless a name stands there, and a stop.
std::string AsSentence(std::string clause) {
  const std::size_t word = clause.find_first_of(" _.=:");
  const bool is_word = word == std::string::npos || clause[word] == ' ';
  if (is_word && !clause.empty()) {
    clause[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(clause[0])));
  }
  const bool stops =
      !clause.empty() && std::string_view(".?!").find(clause.back()) != std::string_view::npos;
  return stops ? clause : clause + ".";
}

/// Where a sentence or a clause ends: after "; " or ". " outside of brackets; the end of the text else.
std::size_t EndOfClause(std::string_view text) {
  int depth = 0;
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')') --depth;
    const bool ends = text[i] == ';' || (text[i] == '.' && i > 0 &&
                                         std::isalpha(static_cast<unsigned char>(text[i - 1])));
    if (depth <= 0 && ends && text[i + 1] == ' ') return i;
  }
  return text.size();
}

void AddClauses(std::string_view text, std::vector<std::string>& sentences) {
  while (!text.empty()) {
    const std::size_t end = EndOfClause(text);
    if (end > 0) sentences.push_back(AsSentence(std::string(text.substr(0, end))));
    text.remove_prefix(std::min(end + 2, text.size()));
  }
}

std::vector<std::string> Clauses(std::string_view text) {
  std::vector<std::string> sentences;
  AddClauses(text, sentences);
  return sentences;
}

/// The remarks that count most: what was found, what would help where the answer failed, and what
/// must be known before numbers that pass are used.
std::vector<std::string> Brief(const Estimate& estimate) {
  const std::vector<std::string> message = Clauses(estimate.message);
  std::vector<std::string> brief;
  if (!message.empty()) brief.push_back(message.front());
  if (estimate.status != Status::ok && message.size() > 1) brief.push_back(message.back());
  for (const std::string& warning : estimate.warnings) {
    if (brief.size() < kBriefly) brief.push_back(AsSentence(warning));
  }
  return brief;
}

std::string RemarksText(const Estimate& estimate, int width, Detail detail) {
  const std::vector<std::string> all = Remarks(estimate);
  const std::vector<std::string> shown = detail == Detail::full ? all : Brief(estimate);
  std::string text;
  for (const std::string& remark : shown) text += fmt::format("  {}\n", remark);
  if (shown.size() < all.size()) {
    const std::size_t more = all.size() - shown.size();
    text += fmt::format("  --explain tells {} more remark{}.\n", more, more == 1 ? "" : "s");
  }
  return Wrap(text, width, 2);
}

Table DiagnosticTable(const Estimate& estimate) {
  Table table{{"test for lack of fit", "p", "effect", "verdict", "finding"}, {}};
  for (const Diagnostic& one : estimate.diagnostics) {
    table.rows.push_back({one.test, one.made ? fmt::format("{:.2g}", one.p_adjusted) : "-",
                          one.made ? fmt::format("{:.2g} {}", one.effect, one.effect_unit) : "-",
                          !one.made      ? "not made"
                          : one.rejected ? "lack of fit"
                                         : "passed",
                          one.reason});
  }
  return table;
}

/// What was assumed, and what each parameter would do were it off by that much.
std::string AssumptionsText(const Estimate& estimate, int width) {
  std::string text;
  for (const Assumption& one : estimate.assumptions) {
    std::vector<std::string> moves;
    for (const auto& [name, change] : one.moves) {
      moves.push_back(fmt::format("{} by {:.2g}", name, change));
    }
    text +=
        fmt::format("  {}: {}; else it moves {}\n", one.name, one.meaning, fmt::join(moves, ", "));
  }
  return text.empty() ? "" : "\nassumptions\n" + Wrap(text, width, 2);
}

/// Every test for lack of fit and every assumption.
std::string Explanation(const Estimate& estimate, int width) {
  const Table tests = DiagnosticTable(estimate);
  std::string text;
  if (!tests.rows.empty()) text = "\n" + TableToText(tests, tests.header.size(), width);
  return text + AssumptionsText(estimate, width);
}

Colour ColourOf(Status status) {
  if (status == Status::ok) return Colour::green;
  return status == Status::bad_data ? Colour::red : Colour::yellow;
}

}  // namespace

std::vector<std::string> Remarks(const Estimate& estimate) {
  std::vector<std::string> remarks = Clauses(estimate.message);
  for (const std::string& warning : estimate.warnings) remarks.push_back(AsSentence(warning));
  return remarks;
}

std::string EstimateToText(const Estimate& estimate, const Measurements& measurements,
                           const Page& page, Detail detail) {
  std::string text =
      fmt::format("{}: {}\n", estimate.identifier,
                  Paint(StatusName(estimate.status), ColourOf(estimate.status), page));
  text += RemarksText(estimate, page.width, detail);
  if (!estimate.parameters.empty())
    text += fmt::format("\n{}", TableToText(ParameterTable(estimate), 1, page.width));

  const std::string& unit = measurements.torque_unit;
  if (estimate.gravity && estimate.gravity->kind == GravityKind::paired) {
    text += PairedGravity(*estimate.gravity, unit);
  }
  Table table{{"fit", "samples", fmt::format("RMSE {}", unit), fmt::format("MAE {}", unit), "Fit %",
               fmt::format("FPE ({})^2", unit)},
              {}};
  AddMetrics(table, "all data", estimate.metrics);
  AddMetrics(table, "held out", estimate.holdout);
  if (!table.rows.empty()) text += fmt::format("\n{}", TableToText(table, 1, page.width));
  if (detail == Detail::full) text += Explanation(estimate, page.width);
  return text;
}

}  // namespace warmjoint::inline tools
