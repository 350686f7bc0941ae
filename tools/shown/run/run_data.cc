#include "tools/shown/run/run_data.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <warmjoint/prepared_log.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "identification/identifiers/identifier_list.h"
#include "identification/model/normal_equations.h"
#include "identification/preparation/select.h"
#include "identification/score/cramer_rao.h"
#include "models/foundation/bad_input.h"
#include "models/friction/thermal.h"
#include "sim/plant/plant.h"
#include "tools/board/board_tables.h"
#include "tools/board/format_board.h"
#include "tools/compensate/arms/arm_list.h"
#include "tools/shown/estimate_data.h"

namespace warmjoint::shown {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Cramer-Rao covariance of the parameters, in the order of the truth's, from simulating the first realization once more. Empty where its
/// plant cannot be made on this machine, or some parameters cannot be told apart.
Eigen::MatrixXd BoundCovariance(const Suite& suite) {
  Eigen::MatrixXd covariance;
  if (suite.contest == Contest::compensators) return covariance;
  try {
    const Simulation recording = MakePlant(suite.scenario)->Run(0);
    const LogSamples m = Prepare(recording.measurements).raw().measurements;
    const Selection selection =
        suite.scenario.plant == PlantKind::ideal ? SelectMoving(m) : SelectConstantSpeed(m);
    const double step = 1 / suite.scenario.sampling.rate;
    covariance = Cofactor(
        CramerRaoBound(m, selection, recording.truth, KnownInitialEnergy::yes, step).information);
  } catch (const BadInput&) {
    return {};
  }
  return covariance.allFinite() ? covariance : Eigen::MatrixXd();
}

/// What the variants of a suite are, in the order of its ladder. A variant without a value counts by its place and goes by its name.
Tree RungsOf(const Suite& suite) {
  Tree rungs{{"variable", ""}, {"unit", ""}, {"values", Tree::array()}, {"names", Tree::array()}};
  if (!suite.ladder) return rungs;
  rungs["variable"] = suite.ladder->variable;
  rungs["unit"] = suite.ladder->unit;
  for (const Variant& variant : suite.ladder->variants) {
    rungs["values"].push_back(variant.value.value_or(static_cast<double>(rungs["values"].size())));
    if (!variant.value) rungs["names"].push_back(variant.name);
  }
  return rungs;
}

/// The noise that all variants have; NaN where they differ, or a filter leaves only some of it.
double NoiseOf(const Suite& suite) {
  const double noise = VariantScenario(suite, 0).noise.torque;
  for (int variant = 0; variant < suite.variants(); ++variant) {
    const Scenario scenario = VariantScenario(suite, variant);
    if (scenario.sampling.cutoff > 0 || scenario.noise.torque != noise) return kUnknown;
  }
  return noise;
}

/// {name: [symbol, unit]} of the parameters that truths of the suite's law have, in their order.
Tree ParametersOf(const Scenario& scenario) {
  Tree parameters = Tree::object();
  const auto add = [&](std::span<const ParameterInfo> table) {
    for (const ParameterInfo& info : table) {
      parameters[std::string(info.name)] = {info.symbol, info.unit.For(scenario.joint_kind)};
    }
  };
  add(FindLaw(scenario.friction.law)->parameters);
  add(Thermal::parameters);
  return parameters;
}

/// What an entry of the suite is: of the list of identifiers, with its options, or a command from outside.
std::string WhatItIs(const SuiteIdentifier& identifier, Contest contest) {
  // a command from outside is its own description
  if (identifier.name == kExternal) {
    const auto command = identifier.options.find("command");
    return "a command from outside" +
           (command == identifier.options.end() ? "" : ": " + command->second);
  }
  // one of the list has a summary, and options that the suite gives
  std::string words = contest == Contest::compensators ? FindCompensator(identifier.name).summary
                                                       : FindIdentifier(identifier.name).summary;
  std::vector<std::string> options;
  for (const auto& [key, value] : identifier.options) options.push_back(key + "=" + value);
  if (!options.empty()) words += fmt::format(" (with {})", fmt::join(options, ", "));
  return words;
}

/// Position of the best identifier of the suite that is none from outside; nothing where all are.
std::optional<std::size_t> BestOfOurs(const Leaderboard& board, const Suite& suite) {
  // by rank on the board, then by its place in the suite
  for (const LeaderboardRow& best : board.rows) {
    for (std::size_t i = 0; i < suite.identifiers.size(); ++i) {
      const SuiteIdentifier& identifier = suite.identifiers[i];
      if (identifier.label == best.identifier && identifier.name != kExternal) return i;
    }
  }
  return std::nullopt;
}

/// Torque and fit of the extremes of the best identifier, each simulated and identified once more; or why there are none.
void AddExtremes(const RunStore& store, const Leaderboard& board, ShownData& data, Tree& facts,
                 const std::function<void(const std::string&)>& tell) {
  const Suite& suite = store.suite();
  facts["extremes"] = Tree::array();
  facts["without_extremes"] = "No identifier of warmjoint's own gave numbers that could be shown.";
  const std::optional<std::size_t> best = BestOfOurs(board, suite);
  if (!best || suite.contest == Contest::compensators) return;
  Tree extremes = Tree::array();
  try {
    for (const Extreme& one : ExtremesOf(store, static_cast<int>(*best))) {
      tell(fmt::format("simulating the {} realization again", one.rank));
      const Replayed again = ReplayUnit(suite, one.unit, suite.identifiers[*best]);
      extremes.push_back({{"rank", one.rank},
                          {"npe", one.npe},
                          {"name", NameOf(suite, one.unit)},
                          {"label", suite.identifiers[*best].label},
                          {"fit", ViewFacts(MakeFitView(again.log, again.estimate), data)}});
    }
  } catch (const BadInput& refusal) {
    // a realization that cannot be repeated is no reason to lose the page
    facts["without_extremes"] = fmt::format("No realization is shown: {}.", refusal.what());
    return;
  }
  facts["extremes"] = std::move(extremes);
}

Tree TableTree(const std::string& caption, const Table& table) {
  return {{"caption", caption}, {"header", table.header}, {"rows", table.rows}};
}

/// The tables of `compare`.
Tree BoardTrees(const Leaderboard& board) {
  if (Compensates(board)) {
    return {TableTree("Who wins: residual", RankingTable(board)),
            TableTree("What each reaches, medians", MeasureTable(board))};
  }
  Tree tables = {TableTree("Who wins: normalised parameter error, NPE", RankingTable(board)),
                 TableTree("Agreement with the data, medians", AgreementTable(board))};
  if (!board.groups.empty()) {
    tables.push_back(TableTree("Rms NPE in each variant, beside its bound", GroupTable(board)));
  }
  const Table parameters = ParameterTable(board);
  if (!parameters.rows.empty()) {
    tables.push_back(TableTree("Each parameter beside its Cramér-Rao bound", parameters));
  }
  return tables;
}

Leaderboard FinishedBoard(const RunStore& store) {
  Leaderboard board = ReadBoard(store);
  if (board.finished > 0) return board;
  Refuse({store.directory().string()},
         "no realization is finished yet; run the suite again to go on");
}

Tree FactsOf(const RunStore& store, const Leaderboard& board, ShownData& data) {
  const Suite& suite = store.suite();
  Tree identifiers = Tree::array();
  for (const SuiteIdentifier& one : suite.identifiers) {
    identifiers.push_back({{"label", one.label}, {"method", CurrentName(one.name)}});
  }
  return {{"database", store.results_file().string()},
          {"suite", suite.name},
          {"realizations", suite.realizations},
          {"identifiers", std::move(identifiers)},
          {"parameters", ParametersOf(suite.scenario)},
          {"rungs", RungsOf(suite)},
          {"torque_unit", std::string(kTorqueUnit.For(suite.scenario.joint_kind))},
          {"noise", NoiseOf(suite)},
          {"bound", data.Hold(BoundCovariance(suite))},
          {"board", Tree::parse(BoardToJson(board))}};
}

}  // namespace

std::vector<Extreme> ExtremesOf(const RunStore& store, int identifier) {
  // equal errors in the order of units, so that the choice is the same on every machine
  SQLite::Statement row(
      store.database(),
      "SELECT variant, realization, npe_continuous FROM result WHERE identifier = ? AND "
      "npe_continuous IS NOT NULL ORDER BY npe_continuous, variant, realization");
  row.bind(1, identifier);
  std::vector<Extreme> answered;
  while (row.executeStep()) {
    const RunUnit unit{row.getColumn(0).getInt(), row.getColumn(1).getInt()};
    answered.push_back({"", unit, row.getColumn(2).getDouble()});
  }
  std::vector<Extreme> extremes;
  const auto take = [&](const char* rank, std::size_t at) {
    const bool taken = std::ranges::any_of(
        extremes, [&](const Extreme& one) { return one.unit == answered[at].unit; });
    if (!taken) extremes.push_back({rank, answered[at].unit, answered[at].npe});
  };
  if (answered.empty()) return extremes;
  take("best", 0);
  take("median", (answered.size() - 1) / 2);
  take("worst", answered.size() - 1);
  return extremes;
}

Tree RunFacts(const RunStore& store, ShownData& data) {
  return FactsOf(store, FinishedBoard(store), data);
}

Tree RunPageFacts(const RunStore& store, ShownData& data,
                  const std::function<void(const std::string&)>& tell) {
  constexpr const char* kRun = "RUN";  // the run's directory, as the page calls it
  const Suite& suite = store.suite();
  const Leaderboard board = FinishedBoard(store);
  Tree facts = FactsOf(store, board, data);
  Tree entries = Tree::array(), replay = Tree::array();
  for (const SuiteIdentifier& one : suite.identifiers)
    entries.push_back({one.label, WhatItIs(one, suite.contest)});
  for (int variant = 0; variant < suite.variants(); ++variant) {
    replay.push_back(ReplayCommand(suite, {variant, 0}, kRun));
  }
  facts["verdict"] = Verdict(board);
  facts["simulated"] = WhatWasSimulated(suite);
  facts["entries"] = std::move(entries);
  facts["boards"] = BoardTrees(board);
  facts["notes"] = Notes(board);
  facts["replay"] = std::move(replay);
  facts["variants"] = Tree::array();
  if (suite.ladder) {
    for (const Variant& one : suite.ladder->variants) facts["variants"].push_back(one.name);
  }
  facts["run"] = kRun;
  facts["versions"] = store.description().versions;
  facts["suite_yaml"] = store.description().suite_yaml;
  AddExtremes(store, board, data, facts, tell);
  return facts;
}

}  // namespace warmjoint::shown
