#include "tools/board/board_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "identification/score/compensation_score.h"

namespace warmjoint {
namespace {

constexpr const char* kUnknown = "-";

/// Two decimals below ten, then fewer: "1.10 %", "23.4 %", "200 %".
std::string Percent(double share, const char* sign) {
  if (std::isnan(share)) return kUnknown;
  if (std::isinf(share)) return "open";  // of one that failed too often
  const double percent = 100 * share;
  const int decimals = percent < 9.995 ? 2 : percent < 99.95 ? 1 : 0;
  return fmt::format("{:.{}f}{}", percent, decimals, sign);
}

std::string MiddleHalf(const Summary& summary) {
  if (std::isnan(summary.median)) return kUnknown;
  return fmt::format("{} .. {}", Percent(summary.q25, ""), Percent(summary.q75, " %"));
}

std::string Seconds(double seconds) {
  if (std::isnan(seconds)) return kUnknown;
  if (seconds < 1e-3) return fmt::format("{:.3g} us", 1e6 * seconds);
  if (seconds < 1) return fmt::format("{:.3g} ms", 1e3 * seconds);
  return fmt::format("{:.3g} s", seconds);
}

std::string FailedCell(const LeaderboardRow& row) {
  return row.failed() == 0 ? "0" : fmt::format("{} of {}", row.failed(), row.runs);
}

/// "tie", or the median distance and its interval.
std::string BehindCell(const LeaderboardRow& row) {
  if (!row.behind) return "";
  if (row.behind->tie()) return "tie";
  if (std::isinf(row.behind->median)) return "fails too often";
  return fmt::format("{} ({} .. {})", PercentText(row.behind->median),
                     Percent(row.behind->lower, ""), Percent(row.behind->upper, ""));
}

/// A row's cell in a variant: rms NPE, which the bound is one of, how it ranks, and how many failed.
std::string VariantCell(const Standing& part, const std::string& identifier) {
  for (const LeaderboardRow& row : part.rows) {
    if (row.identifier != identifier) continue;
    std::string cell = PercentText(row.npe_continuous.rms);
    if (IsBestOrTied(row)) cell += row.behind ? " tie" : " best";
    return row.failed() == 0 ? cell : fmt::format("{} ({} failed)", cell, row.failed());
  }
  return kUnknown;
}

/// The numbers of an identifier in the variants, from the least to the largest; one where all have one text.
/// number: of a row and what it is part of; text: of such a number.
template <typename Number, typename Text>
std::string OverVariants(const Leaderboard& board, const std::string& identifier,
                         const Number& number, const Text& text, const char* between = " .. ") {
  std::vector<double> numbers;
  for (const auto& [variant, part] : PartsOf(board)) {
    for (const LeaderboardRow& row : part->rows) {
      if (row.identifier != identifier) continue;
      if (const double one = number(row, *part); std::isfinite(one)) numbers.push_back(one);
    }
  }
  if (numbers.empty()) return kUnknown;
  // both ends, where they differ
  const auto [least, largest] = std::minmax_element(numbers.begin(), numbers.end());
  const std::string first = text(*least), last = text(*largest);
  return first == last ? first : first + between + last;
}

/// rms NPE over that of the bound.
double TimesTheBound(const LeaderboardRow& row, const Standing& part) {
  return row.npe_continuous.rms / part.bound_npe_continuous;
}

/// Median of the measure that ranks, %.
double Residual(const LeaderboardRow& row, const Standing&) {
  return row.measures.empty() ? std::nan("") : row.measures.front().summary.median;
}

/// Its place, of who takes part.
std::string PlaceText(const LeaderboardRow& row, std::size_t i) {
  return row.standard == Standard::truth ? "" : std::to_string(i + 1);
}

/// How far a compensator is behind the best, in points of per cent.
std::string PointsBehind(const LeaderboardRow& row) {
  if (!row.behind) return "";
  if (row.behind->tie()) return "tie";
  if (std::isinf(row.behind->median)) return "fails too often";
  return fmt::format("{} ({} .. {})", NumberText(row.behind->median), NumberText(row.behind->lower),
                     NumberText(row.behind->upper));
}

Table RankingOfCompensators(const Leaderboard& board) {
  Table table{{"#", "compensator", "failed", "residual %", "quartiles", "above best"}, {}};
  for (size_t i = 0; i < board.rows.size(); ++i) {
    const LeaderboardRow& row = board.rows[i];
    const Summary of = row.measures.empty() ? Summary{} : row.measures.front().summary;
    const bool known = !row.measures.empty();
    table.rows.push_back(
        {PlaceText(row, i), row.identifier, FailedCell(row),
         known ? NumberText(of.median) : kUnknown,
         known ? fmt::format("{} .. {}", NumberText(of.q25), NumberText(of.q75)) : kUnknown,
         PointsBehind(row)});
  }
  return table;
}

/// What stands above the names of variants.
std::string VariantHead(const Leaderboard& board) {
  return board.variable.empty() ? "variant" : board.variable;
}

/// Of a ladder: in how many of its variants each identifier is as good as any.
Table RankingOverVariants(const Leaderboard& board) {
  const bool compensates = Compensates(board);
  Table table{{"#", "identifier", "best or tied", "failed", "rms / bound"}, {}};
  if (compensates) table.header = {"#", "compensator", "best or tied", "failed", "residual %"};
  for (size_t i = 0; i < board.rows.size(); ++i) {
    const LeaderboardRow& row = board.rows[i];
    if (compensates) {
      table.rows.push_back({PlaceText(row, i), row.identifier,
                            fmt::format("{} of {}", *row.best_or_tied, board.groups.size()),
                            FailedCell(row),
                            OverVariants(board, row.identifier, Residual, NumberText)});
      continue;
    }
    table.rows.push_back({std::to_string(i + 1), row.identifier,
                          fmt::format("{} of {}", *row.best_or_tied, board.groups.size()),
                          FailedCell(row),
                          OverVariants(board, row.identifier, TimesTheBound, NumberText)});
  }
  return table;
}

}  // namespace

std::string PercentText(double share) { return Percent(share, " %"); }

std::string NumberText(double value) {
  return std::isfinite(value) ? fmt::format("{:.3g}", value) : kUnknown;
}

std::vector<std::pair<std::string, const Standing*>> PartsOf(const Leaderboard& board) {
  std::vector<std::pair<std::string, const Standing*>> parts;
  for (const VariantStanding& group : board.groups) parts.emplace_back(group.variant, &group);
  if (parts.empty()) parts.emplace_back("all", &board);
  return parts;
}

Table RankingTable(const Leaderboard& board) {
  if (!board.groups.empty()) return RankingOverVariants(board);
  if (Compensates(board)) return RankingOfCompensators(board);
  Table table{{"#", "identifier", "failed", "NPE median", "quartiles", "NPE rms", "rms / bound",
               "NPE above best", "discrete NPE", "rms"},
              {}};
  // a row for each identifier, the best one first
  for (size_t i = 0; i < board.rows.size(); ++i) {
    const LeaderboardRow& row = board.rows[i];
    table.rows.push_back({std::to_string(i + 1), row.identifier, FailedCell(row),
                          PercentText(row.npe_continuous.median), MiddleHalf(row.npe_continuous),
                          PercentText(row.npe_continuous.rms),
                          NumberText(TimesTheBound(row, board)), BehindCell(row),
                          PercentText(row.npe_discrete.median), PercentText(row.npe_discrete.rms)});
  }
  // the bound as the last row
  if (!std::isnan(board.bound_npe_continuous)) {
    table.rows.push_back({"", "Cramer-Rao bound", "", "", "",
                          PercentText(board.bound_npe_continuous), "1", "", "",
                          PercentText(board.bound_npe_discrete)});
  }
  return table;
}

Table GroupTable(const Leaderboard& board) {
  // a row a variant, a column an identifier
  Table table{{VariantHead(board), "bound"}, {}};
  for (const LeaderboardRow& row : board.rows) table.header.push_back(row.identifier);
  for (const VariantStanding& group : board.groups) {
    table.rows.push_back({group.variant, PercentText(group.bound_npe_continuous)});
    for (const LeaderboardRow& row : board.rows) {
      table.rows.back().push_back(VariantCell(group, row.identifier));
    }
  }
  return table;
}

bool Compensates(const Leaderboard& board) {
  return std::ranges::any_of(board.rows,
                             [](const LeaderboardRow& row) { return !row.measures.empty(); });
}

Table MeasureTable(const Leaderboard& board) {
  // columns of what anybody has
  const std::string_view unit = kTorqueUnit.For(board.joint);
  const auto of = [](const LeaderboardRow& row, std::size_t i) {
    return i < row.measures.size() ? row.measures[i].summary.median : std::nan("");
  };
  std::vector<std::size_t> shown;
  Table table{{"compensator"}, {}};
  for (std::size_t i = 0; i < kCompensationMeasures.size(); ++i) {
    const CompensationMeasure& measure = kCompensationMeasures[i];
    const auto has = [&](const LeaderboardRow& row) { return std::isfinite(of(row, i)); };
    if (std::ranges::none_of(board.rows, has)) continue;
    shown.push_back(i);
    table.header.push_back(fmt::format("{} {}", measure.label, measure.is_share ? "%" : unit));
  }
  table.header.emplace_back("time");
  // a row for each, of each variant by itself
  for (auto [variant, part] : PartsOf(board)) {
    for (const LeaderboardRow& row : part->rows) {
      std::vector<std::string> cells{row.identifier};
      for (const std::size_t i : shown) cells.push_back(NumberText(of(row, i)));
      cells.push_back(Seconds(row.seconds.median));
      if (!board.groups.empty()) cells.insert(cells.begin(), variant);
      variant.clear();
      table.rows.push_back(std::move(cells));
    }
  }
  if (!board.groups.empty()) table.header.insert(table.header.begin(), VariantHead(board));
  return table;
}

Table AgreementTable(const Leaderboard& board) {
  const std::string_view unit = kTorqueUnit.For(board.joint);
  Table table{{"identifier", fmt::format("RMSE {}", unit), fmt::format("MAE {}", unit), "Fit %",
               fmt::format("FPE ({})^2", unit), "time"},
              {}};
  // medians over the runs, of each variant by itself: over different noise they say nothing
  for (auto [variant, part] : PartsOf(board)) {
    for (const LeaderboardRow& row : part->rows) {
      table.rows.push_back({row.identifier, NumberText(row.rmse.median), NumberText(row.mae.median),
                            NumberText(row.fit.median), NumberText(row.fpe.median),
                            Seconds(row.seconds.median)});
      if (board.groups.empty()) continue;
      // the variant is named once for all of its rows
      table.rows.back().insert(table.rows.back().begin(), variant);
      variant.clear();
    }
  }
  if (!board.groups.empty()) table.header.insert(table.header.begin(), VariantHead(board));
  return table;
}

Table ParameterTable(const Leaderboard& board) {
  Table table{{"identifier", "parameter", "rms error / bound", "95 % coverage"}, {}};
  for (const LeaderboardRow& row : board.rows) {
    std::string label = row.identifier;
    // the identifier is named once for all of its parameters
    for (const ParameterRow& parameter : row.parameters) {
      const std::string coverage =
          parameter.coverage95 ? PercentText(*parameter.coverage95) : std::string(kUnknown);
      const auto efficiency = [&](const LeaderboardRow& in, const Standing&) {
        for (const ParameterRow& one : in.parameters) {
          if (one.name == parameter.name) return one.efficiency;
        }
        return std::nan("");
      };
      table.rows.push_back({label, parameter.name,
                            OverVariants(board, row.identifier, efficiency, NumberText), coverage});
      label.clear();
    }
  }
  return table;
}

std::string Verdict(const Leaderboard& board) {
  const bool compensates = Compensates(board);
  if (board.rows.empty() ||
      (!compensates && std::isnan(board.rows.front().npe_continuous.median))) {
    return "No identifier gave numbers.";
  }
  // the best one with its error, or in how many variants it is that
  const LeaderboardRow& best = board.rows.front();
  std::string verdict = board.groups.empty()
                            ? fmt::format("{} is best: its median {} is {}", best.identifier,
                                          compensates ? "residual" : "NPE",
                                          compensates ? NumberText(Residual(best, board)) + " %"
                                                      : PercentText(best.npe_continuous.median))
                            : fmt::format("{} is best or tied in {} of {} variants",
                                          best.identifier, *best.best_or_tied, board.groups.size());
  const auto times = [](double number) { return fmt::format("{:.2f}", number); };
  const std::string bound = OverVariants(board, best.identifier, TimesTheBound, times, " to ");
  if (bound != kUnknown) verdict += fmt::format(", its rms {} times the Cramer-Rao bound", bound);
  // others that cannot be told from it
  std::vector<std::string> others;
  for (const LeaderboardRow& row : board.rows) {
    if (row.behind && row.behind->tie()) others.push_back(row.identifier);
    if (&row != &best && row.best_or_tied.value_or(0) > 0)
      others.push_back(fmt::format("{} in {}", row.identifier, *row.best_or_tied));
  }
  if (!others.empty())
    verdict +=
        fmt::format("; {}{}", board.groups.empty() ? "tied with " : "", fmt::join(others, ", "));
  if (best.failed() > 0) verdict += fmt::format("; {} of {} runs failed", best.failed(), best.runs);
  return verdict + ".";
}

namespace {

/// A figure of a claim as a reader sees it: "RMSE 0.5 N.m".
struct FigureText {
  const char* label;
  Summary LeaderboardRow::*reached;
  std::string (*text)(double value, std::string_view unit);
};

const std::map<std::string, FigureText>& FigureTexts() {
  // how each figure is written with its unit
  const auto share = [](double value, std::string_view) { return PercentText(value); };
  const auto percent = [](double value, std::string_view) {
    return fmt::format("{:.3f} %", value);
  };
  const auto linear = [](double value, std::string_view unit) {
    return fmt::format("{} {}", NumberText(value), unit);
  };
  const auto squared = [](double value, std::string_view unit) {
    return fmt::format("{} ({})^2", NumberText(value), unit);
  };
  // figures that a claim may be about
  static const std::map<std::string, FigureText> texts{
      {"npe_continuous", {"NPE", &LeaderboardRow::npe_continuous, share}},
      {"npe_discrete", {"discrete NPE", &LeaderboardRow::npe_discrete, share}},
      {"rmse", {"RMSE", &LeaderboardRow::rmse, linear}},
      {"mae", {"MAE", &LeaderboardRow::mae, linear}},
      {"fit", {"Fit", &LeaderboardRow::fit, percent}},
      {"fpe", {"FPE", &LeaderboardRow::fpe, squared}},
  };
  return texts;
}

std::string ClaimNote(const Leaderboard& board, const LeaderboardRow& row) {
  const std::string_view unit = kTorqueUnit.For(board.joint);
  // what is claimed and what was reached, figure by figure
  std::vector<std::string> claimed, reached;
  for (const auto& [name, value] : row.claim->figures) {
    const FigureText& figure = FigureTexts().at(name);
    const auto text = [&](double number) { return figure.text(number, unit); };
    const auto median = [&](const LeaderboardRow& in, const Standing&) {
      return (in.*figure.reached).median;
    };
    claimed.push_back(fmt::format("{} {}", figure.label, text(value)));
    reached.push_back(
        fmt::format("{} {}", figure.label, OverVariants(board, row.identifier, median, text)));
  }
  return fmt::format("{}: the claim is {} ({}); the median here is {}", row.identifier,
                     fmt::join(claimed, ", "), row.claim->source, fmt::join(reached, ", "));
}

std::string FailureNote(const LeaderboardRow& row) {
  std::vector<std::string> counts;
  for (const auto& [status, count] : row.failures) {
    counts.push_back(fmt::format("{} {}", count, status));
  }
  return fmt::format("{}: {} of {} runs failed ({}), for example: {}", row.identifier, row.failed(),
                     row.runs, fmt::join(counts, ", "), row.failure_example);
}

/// Whether errors of `efficiency` (rms error / Cramer-Rao bound) in n realizations are smaller than
/// chance makes them. At the bound their squares add up to a chi-squared number with n degrees of
/// freedom, which is below n x with a chance of at most (x exp(1 - x))^(n/2), x < 1 (Chernoff).
/// Shrinking estimators lie below the bound too, but not ten times: that would be a hundred times
/// the data.
bool IsTooGood(double efficiency, int n) {
  constexpr double kFar = 0.1, kChance = 1e-6;
  const double x = efficiency * efficiency;
  return efficiency < kFar && std::pow(x * std::exp(1 - x), n / 2.0) < kChance;
}

/// Names of the parameters that the row knows better than its data can tell.
std::vector<std::string> TooGood(const LeaderboardRow& row) {
  std::vector<std::string> names;
  for (const ParameterRow& parameter : row.parameters) {
    if (IsTooGood(parameter.efficiency, row.runs - row.failed())) names.push_back(parameter.name);
  }
  return names;
}

}  // namespace

std::vector<std::string> Notes(const Leaderboard& board) {
  std::vector<std::string> notes;
  for (const LeaderboardRow& row : board.rows) {
    // what its author claims, where it failed, where it is too good to be true
    if (row.claim) notes.push_back(ClaimNote(board, row));
    if (row.failed() > 0) notes.push_back(FailureNote(row));
    if (const auto names = TooGood(row); !names.empty()) {
      notes.push_back(
          fmt::format("{}: its errors in {} lie far below the Cramer-Rao bound. By chance that "
                      "happens once in a million: does it know the truth?",
                      row.identifier, fmt::join(names, ", ")));
    }
    // parameters that are left out count as wrong by their whole size
    if (!row.not_estimated.empty()) {
      notes.push_back(fmt::format("{} does not estimate {}, which count as 0", row.identifier,
                                  fmt::join(row.not_estimated, ", ")));
    }
  }
  // the board of a run that goes on
  if (board.finished < board.realizations) {
    notes.push_back(fmt::format("unfinished: {} of {} realizations; run the suite again to go on",
                                board.finished, board.realizations));
  }
  return notes;
}

}  // namespace warmjoint
