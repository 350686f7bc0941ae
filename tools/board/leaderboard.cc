// The leaderboard by questions to the run's database.
#include "tools/board/leaderboard.h"

#include <SQLiteCpp/VariadicBind.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "tools/board/statistics.h"
#include "tools/store/database.h"

namespace warmjoint {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// A figure of each result, and where its summary goes.
struct Figure {
  const char* column;
  Summary LeaderboardRow::*summary;
};

constexpr std::array<Figure, 7> kFigures{{{"npe_continuous", &LeaderboardRow::npe_continuous},
                                          {"npe_discrete", &LeaderboardRow::npe_discrete},
                                          {"rmse", &LeaderboardRow::rmse},
                                          {"fit", &LeaderboardRow::fit},
                                          {"fpe", &LeaderboardRow::fpe},
                                          {"mae", &LeaderboardRow::mae},
                                          {"seconds", &LeaderboardRow::seconds}}};

/// Puts questions on the realizations of a store's variants first .. last.
struct Questions {
  const RunStore& store;
  int first = 0;
  int last = 0;

  /// The query's ?1 and ?2 are the first and the last variant, the following ones `more`.
  template <typename... More>
  SQLite::Statement Ask(const std::string& query, const More&... more) const {
    SQLite::Statement statement(store.database(), query);
    SQLite::bind(statement, first, last, more...);
    return statement;
  }
};

/// Failures by status, and the message of the first one.
void AddFailures(const Questions& questions, int identifier, LeaderboardRow& row) {
  SQLite::Statement counts = questions.Ask(
      "SELECT status, count(*) FROM result WHERE variant BETWEEN ?1 AND ?2 AND identifier = ?3 AND "
      "status <> 'ok' GROUP BY status",
      identifier);
  while (counts.executeStep()) {
    row.failures[counts.getColumn(0).getString()] = counts.getColumn(1).getInt();
  }
  SQLite::Statement first = questions.Ask(
      "SELECT message FROM result WHERE variant BETWEEN ?1 AND ?2 AND identifier = ?3 AND status "
      "<> 'ok' AND message <> '' ORDER BY variant, realization LIMIT 1",
      identifier);
  if (first.executeStep()) row.failure_example = first.getColumn(0).getString();
}

/// Medians and quartiles of all figures. A run without an NPE counts for the rank as infinitely wrong,
/// so that nobody wins by answering the easy ones alone.
void AddFigures(const Questions& questions, int identifier, LeaderboardRow& row) {
  std::string columns;
  for (const Figure& figure : kFigures) columns += fmt::format(", {}", figure.column);
  SQLite::Statement results = questions.Ask("SELECT variant" + columns +
                                                " FROM result WHERE variant BETWEEN ?1 AND ?2 AND "
                                                "identifier = ?3 ORDER BY variant, realization",
                                            identifier);
  std::array<std::vector<double>, kFigures.size()> numbers;
  for (; results.executeStep(); ++row.runs) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      numbers[i].push_back(NumberIn(results.getColumn(static_cast<int>(i) + 1)));
    }
  }
  std::vector<double> ranked = numbers.front();
  std::replace_if(
      ranked.begin(), ranked.end(), [](double npe) { return std::isnan(npe); }, kInfinite);
  row.rank_npe = Summarise(std::move(ranked)).median;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    row.*kFigures[i].summary = Summarise(std::move(numbers[i]));
  }
}

/// What a compensator reached. It ranks by its first measure, a run without one as infinitely wrong.
void AddMeasures(const Questions& questions, int identifier, LeaderboardRow& row) {
  SQLite::Statement one = questions.Ask(
      "SELECT name, value FROM measure WHERE variant BETWEEN ?1 AND ?2 AND identifier = ?3 ORDER "
      "BY position, variant, realization",
      identifier);
  std::vector<std::pair<std::string, std::vector<double>>> all;
  while (one.executeStep()) {
    const std::string name = one.getColumn(0).getString();
    if (all.empty() || all.back().first != name) all.push_back({name, {}});
    all.back().second.push_back(NumberIn(one.getColumn(1)));
  }
  if (all.empty()) return;
  std::vector<double> ranked = all.front().second;
  std::replace_if(
      ranked.begin(), ranked.end(), [](double value) { return std::isnan(value); }, kInfinite);
  ranked.resize(std::max(ranked.size(), static_cast<std::size_t>(row.runs)), kInfinite);
  row.rank_npe = Summarise(std::move(ranked)).median;
  for (auto& [name, values] : all) row.measures.push_back({name, Summarise(std::move(values))});
}

/// One continuous parameter of the truth in all results.
struct ParameterErrors {
  std::string name;
  int intervals = 0;                 // 95 % intervals that were given
  int covered = 0;                   // of them, those that hold the truth
  std::vector<double> error, bound;  // of what was estimated
};

/// Coverage of the intervals, and rms errors over the Cramer-Rao bound. Truths of a ladder may have other
/// parameters: each goes by its name.
void AddParameters(const Questions& questions, int identifier, LeaderboardRow& row) {
  SQLite::Statement one = questions.Ask(
      "SELECT name, covered, estimated, estimate - truth, bound FROM parameter WHERE variant "
      "BETWEEN ?1 AND ?2 AND identifier = ?3 AND discrete = 0 ORDER BY variant, realization, "
      "position",
      identifier);
  std::vector<ParameterErrors> all;
  while (one.executeStep()) {
    const std::string name = one.getColumn(0).getString();
    auto errors = std::find_if(all.begin(), all.end(),
                               [&](const ParameterErrors& known) { return known.name == name; });
    if (errors == all.end()) errors = all.insert(all.end(), {name, 0, 0, {}, {}});
    errors->intervals += !one.getColumn(1).isNull();
    errors->covered += one.getColumn(1).getInt() != 0;
    if (one.getColumn(2).getInt() == 0) continue;
    errors->error.push_back(NumberIn(one.getColumn(3)));
    errors->bound.push_back(NumberIn(one.getColumn(4)));
  }
  for (const ParameterErrors& errors : all) {
    ParameterRow parameter{errors.name, {}, 0};
    if (errors.intervals > 0) {
      parameter.coverage95 = static_cast<double>(errors.covered) / errors.intervals;
    }
    parameter.efficiency = RootMeanSquareOf(errors.error) / RootMeanSquareOf(errors.bound);
    row.parameters.push_back(std::move(parameter));
    if (errors.error.empty()) row.not_estimated.push_back(errors.name);
  }
}

/// By pairs of the same realization; two that fail alike do not differ.
Difference Behind(const Questions& questions, int identifier, int best) {
  constexpr const char* by_parameters =
      "SELECT a.npe_continuous, b.npe_continuous FROM result AS a JOIN result AS b USING (variant, "
      "realization) WHERE variant BETWEEN ?1 AND ?2 AND a.identifier = ?3 AND b.identifier = ?4";
  constexpr const char* by_measure =
      "SELECT a.value, b.value FROM realization AS r "
      "LEFT JOIN measure AS a ON a.variant = r.variant AND a.realization = r.realization AND "
      "a.identifier = ?3 AND a.position = 0 "
      "LEFT JOIN measure AS b ON b.variant = r.variant AND b.realization = r.realization AND "
      "b.identifier = ?4 AND b.position = 0 "
      "WHERE r.variant BETWEEN ?1 AND ?2";
  const bool compensates = questions.store.suite().contest == Contest::compensators;
  SQLite::Statement pair =
      questions.Ask(compensates ? by_measure : by_parameters, identifier, best);
  const auto ranked = [&](int column) {
    return pair.getColumn(column).isNull() ? kInfinite : pair.getColumn(column).getDouble();
  };
  std::vector<double> differences;
  while (pair.executeStep()) {
    const double a = ranked(0), b = ranked(1);
    differences.push_back(a == b ? 0 : a - b);
  }
  return MedianDifference(std::move(differences));
}

/// Best first; NaN, which an identifier without any run has, then who knows the truth.
bool Better(const LeaderboardRow& a, const LeaderboardRow& b) {
  const auto key = [](const LeaderboardRow& row) {
    const double rms = row.npe_continuous.rms;
    return std::tuple(row.standard == Standard::truth,
                      std::isnan(row.rank_npe) ? kInfinite : row.rank_npe,
                      std::isnan(rms) ? kInfinite : rms);
  };
  return key(a) < key(b);
}

/// Rows, best first, each with its distance from the best.
std::vector<LeaderboardRow> Rank(const Questions& questions) {
  std::vector<std::pair<LeaderboardRow, int>> rows;
  for (const SuiteIdentifier& identifier : questions.store.suite().identifiers) {
    const auto position = static_cast<int>(rows.size());
    LeaderboardRow& row = rows.emplace_back(LeaderboardRow{}, position).first;
    row.identifier = identifier.label;
    row.claim = identifier.claim;
    const bool compensates = questions.store.suite().contest == Contest::compensators;
    if (compensates && identifier.name == kTruthCompensator) row.standard = Standard::truth;
    AddFailures(questions, position, row);
    AddFigures(questions, position, row);
    AddMeasures(questions, position, row);
    AddParameters(questions, position, row);
  }
  // ranks by error, and suite order where two are equal
  std::stable_sort(rows.begin(), rows.end(),
                   [](const auto& a, const auto& b) { return Better(a.first, b.first); });

  // all others are compared with the best one, realization by realization: errors of different variants are not alike
  std::vector<LeaderboardRow> ranked;
  for (auto& [row, position] : rows) {
    const bool takes_part = row.standard == Standard::contestant;
    if (takes_part && !ranked.empty() && questions.first == questions.last) {
      row.behind = Behind(questions, position, rows.front().second);
    }
    ranked.push_back(std::move(row));
  }
  return ranked;
}

/// Root mean squares of the NPE at the Cramer-Rao bound, once a unit: by the first result that knows it.
void AddBounds(const Questions& questions, Standing& sum) {
  SQLite::Statement unit = questions.Ask(
      "SELECT bound_npe_continuous, bound_npe_discrete, min(identifier) FROM result WHERE variant "
      "BETWEEN ?1 AND ?2 AND coalesce(bound_npe_continuous, bound_npe_discrete) IS NOT NULL GROUP "
      "BY variant, realization ORDER BY variant, realization");
  std::vector<double> continuous, discrete;
  while (unit.executeStep()) {
    continuous.push_back(NumberIn(unit.getColumn(0)));
    discrete.push_back(NumberIn(unit.getColumn(1)));
  }
  sum.bound_npe_continuous = RootMeanSquareOf(continuous);
  sum.bound_npe_discrete = RootMeanSquareOf(discrete);
}

Standing SumUp(const Questions& questions) {
  // how many, how well it could be done, and how well it was done
  Standing sum;
  const int variants = questions.last - questions.first + 1;
  sum.realizations = questions.store.suite().realizations * variants;
  SQLite::Statement units =
      questions.Ask("SELECT count(*) FROM realization WHERE variant BETWEEN ?1 AND ?2");
  units.executeStep();
  sum.finished = units.getColumn(0).getInt();
  AddBounds(questions, sum);
  sum.rows = Rank(questions);
  return sum;
}

/// Orders a ladder's rows by the variants in which they are best or tied, then by the sum of their places.
void RankByVariants(Leaderboard& board) {
  std::map<std::string, int> wins;
  std::map<std::string, std::size_t> places;
  for (const VariantStanding& group : board.groups) {
    for (std::size_t i = 0; i < group.rows.size(); ++i) {
      wins[group.rows[i].identifier] += IsBestOrTied(group.rows[i]);
      places[group.rows[i].identifier] += i;
    }
  }
  for (LeaderboardRow& row : board.rows) row.best_or_tied = wins[row.identifier];
  std::stable_sort(board.rows.begin(), board.rows.end(),
                   [&](const LeaderboardRow& a, const LeaderboardRow& b) {
                     return std::pair(-*a.best_or_tied, places[a.identifier]) <
                            std::pair(-*b.best_or_tied, places[b.identifier]);
                   });
}

}  // namespace

int LeaderboardRow::failed() const {
  int count = 0;
  for (const auto& [status, runs_of_it] : failures) count += runs_of_it;
  return count;
}

bool IsBestOrTied(const LeaderboardRow& row) {
  const bool answered =
      row.measures.empty() ? !std::isnan(row.npe_continuous.median) : std::isfinite(row.rank_npe);
  return answered && row.standard == Standard::contestant && (!row.behind || row.behind->tie());
}

Leaderboard ReadBoard(const RunStore& store) {
  return Guarded(store.results_file(), [&] {
    // all variants together
    const Suite& suite = store.suite();
    Leaderboard board;
    static_cast<Standing&>(board) = SumUp({store, 0, suite.variants() - 1});
    board.suite = suite.name;
    board.question = suite.question;
    board.joint = suite.scenario.joint_kind;
    if (!suite.ladder) return board;

    // each rung of the ladder, and who is good at how many
    board.variable = suite.ladder->variable;
    if (!suite.ladder->unit.empty()) board.variable += " " + suite.ladder->unit;
    for (int i = 0; i < suite.variants(); ++i) {
      const Variant& variant = suite.ladder->variants[static_cast<std::size_t>(i)];
      board.groups.push_back({SumUp({store, i, i}), variant.name, variant.value});
    }
    RankByVariants(board);
    return board;
  });
}

}  // namespace warmjoint
