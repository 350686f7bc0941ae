// What the tables of a leaderboard leave to be said.
#include <fmt/format.h>

#include <cmath>
#include <map>

#include "tools/board/board_tables.h"

namespace warmjoint::inline tools {
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

std::string ClaimNote(const LeaderboardRow& row, std::string_view unit) {
  // what is claimed and what was reached, figure by figure
  std::vector<std::string> claimed, reached;
  for (const auto& [name, value] : row.claim->figures) {
    const FigureText& figure = FigureTexts().at(name);
    const Summary& summary = row.*figure.reached;
    claimed.push_back(fmt::format("{} {}", figure.label, figure.text(value, unit)));
    reached.push_back(fmt::format("{} {}", figure.label, figure.text(summary.median, unit)));
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
    if (row.claim) notes.push_back(ClaimNote(row, kTorqueUnit.For(board.joint)));
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

}  // namespace warmjoint::inline tools
