#include "tools/figures/run/run_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "identification/identifiers/identifier_list.h"
#include "models/foundation/serialize.h"
#include "scenarios/suite.h"
#include "tools/board/board_tables.h"
#include "tools/board/format_board.h"
#include "tools/figures/axes.h"
#include "tools/figures/fit_panels.h"
#include "tools/figures/symbols.h"
#include "tools/suite/run_realization.h"

namespace warmjoint::figures {
namespace {

std::string PlantOf(const Scenario& scenario) {
  if (scenario.plant == PlantKind::ideal) {
    return "Each realization is a joint that follows the equations of friction and warming "
           "exactly, without a robot around it.";
  }
  return fmt::format(
      "Each realization is the joint {} of the robot {} in MuJoCo, driven by a controller and "
      "braked by the friction of warmjoint's plugin.",
      scenario.joint, scenario.robot);
}

std::string FrictionOf(const Scenario& scenario) {
  const Friction& friction = scenario.friction;
  std::string words = fmt::format("Its friction follows the law {}", friction.law);
  if (!friction.maps.empty()) words += ", and depends on position";
  if (friction.thermal) {
    words += fmt::format(
        "; it {} as the joint warms by its own losses, with a time constant of {:g} s",
        friction.thermal->gain < 0 ? "falls" : "grows", friction.thermal->time_constant);
  }
  return words + ".";
}

std::string MotionOf(const Scenario& scenario) {
  const bool turns = scenario.joint_kind == JointKind::rotary;
  const Motion& motion = scenario.motion;
  // what kind of motion the scenario asks for
  std::string words = "It moves forwards and backwards at constant speeds";
  if (!motion.corners.empty()) words = "It repeats a recorded motion";
  if (motion.fourier) words = "It moves by Fourier excitation, which never holds a speed";
  if (motion.moves) words = "It moves from place to place, as in pick and place";
  if (!motion.phases.empty()) words = "It works in phases of motion and rest";
  // its speeds, and how long it holds each
  if (!motion.speeds.list.empty()) {
    words +=
        fmt::format(" of {:g} {}", fmt::join(motion.speeds.list, ", "), turns ? "rad/s" : "m/s");
  }
  if (motion.hold > 0) words += fmt::format(", each held for {:g} s", motion.hold);
  return words + ".";
}

std::string LogOf(const Scenario& scenario) {
  return fmt::format(
      "The log is sampled at {:g} Hz for {:g} s. An identifier gets time, position, velocity and "
      "torque, and neither the truth nor a temperature.",
      scenario.sampling.rate, scenario.duration);
}

std::string NoiseOf(const Scenario& scenario) {
  std::string words;
  if (scenario.noise.torque > 0) {
    words = fmt::format("The torque has noise of {:g} {}.", scenario.noise.torque,
                        UnitText(kTorqueUnit.For(scenario.joint_kind)));
  }
  // what is at its default is not written
  if (!WriteFields(scenario.disturbances).empty()) {
    words += fmt::format("{}Disturbances that no identifier is told of stand in suite.yaml below.",
                         words.empty() ? "" : " ");
  }
  return words;
}

std::string LadderOf(const Ladder& ladder) {
  std::vector<std::string> names;
  for (const Variant& variant : ladder.variants) names.push_back(variant.name);
  const std::string what = ladder.variable.empty() ? "what is changed" : ladder.variable;
  return fmt::format("There are {} variants, by {}: {}.", names.size(), what,
                     fmt::join(names, ", "));
}

/// What each realization of the suite is, one sentence each: plant, friction, motion, log, variants.
std::vector<std::string> WhatWasSimulated(const Suite& suite) {
  const Scenario& scenario = suite.scenario;
  std::vector<std::string> sentences{PlantOf(scenario), FrictionOf(scenario), MotionOf(scenario),
                                     LogOf(scenario)};
  const std::string noise = NoiseOf(scenario);
  if (!noise.empty()) sentences.push_back(noise);
  if (suite.ladder) sentences.push_back(LadderOf(*suite.ladder));
  return sentences;
}

/// What an entry of the suite is: of the list of identifiers, with its options, or a command from outside.
std::string WhatItIs(const SuiteIdentifier& identifier) {
  // a command from outside is its own description
  if (identifier.name == kExternal) {
    const auto command = identifier.options.find("command");
    return "a command from outside" +
           (command == identifier.options.end() ? "" : ": " + command->second);
  }
  // an identifier of the list has a summary, and options that the suite gives
  std::string words = FindIdentifier(identifier.name).summary;
  std::vector<std::string> options;
  for (const auto& [key, value] : identifier.options) options.push_back(key + "=" + value);
  if (!options.empty()) words += fmt::format(" (with {})", fmt::join(options, ", "));
  return words;
}

/// Terms of a run's page with their meaning.
constexpr auto kRunTerms = std::to_array<std::pair<const char*, const char*>>({
    {"realization",
     "One simulated log: its noise, and where the suite says so its truth and motion, are drawn "
     "anew."},
    {"identifier", "A method that finds the friction's parameters in a log."},
    {"NPE",
     "Normalised parameter error: the length of the vector of relative errors of all parameters, "
     "against the known truth. 1 % is one part in a hundred. The discrete NPE is that of the two "
     "parameters of the sampled warming, as in the paper."},
    {"Cramér-Rao bound",
     "The error that no unbiased method can undercut on such logs, by their noise and length. An "
     "rms NPE of 1.0 times the bound cannot be bettered."},
    {"NPE above best",
     "How much larger an identifier's NPE is than the best one's on the same realization, median "
     "with a 95 % interval; where it holds 0 the two are tied."},
    {"RMSE, MAE", "Root mean square error and mean absolute error of the fitted torque."},
    {"Fit", "1 − norm of the residual over norm of the torque's variation, in per cent."},
    {"FPE", "Final prediction error: the mean square error, raised for each parameter fitted."},
    {"interval holds the truth",
     "Share of 95 % intervals that contain the true value; 95 % is right."},
    {"failure",
     "A realization for which the identifier gave no numbers, or called its numbers void."},
});

// the run's directory, as the page calls it
constexpr const char* kRun = "RUN";

using BoardTable = warmjoint::Table;

Tree TableTree(const std::string& caption, const BoardTable& table) {
  return {{"caption", caption}, {"header", table.header}, {"rows", table.rows}};
}

/// Each answer with how well it did, and how to make its log again.
BoardTable RealizationTable(const RunPage& page) {
  const Suite& suite = page.suite;
  BoardTable table{
      {"realization", "identifier", "answer", "NPE",
       fmt::format("RMSE ({})", page.view.torque_unit), "Fit (%)", "simulate it again"},
      {}};
  if (suite.ladder) table.header.insert(table.header.begin() + 1, "variant");
  for (const ListedAnswer& answer : page.view.listing.answers) {
    std::vector<std::string> row{
        fmt::format("{}", answer.unit.realization),
        suite.identifiers.at(static_cast<std::size_t>(answer.identifier)).label,
        answer.status,
        PercentText(answer.npe),
        warmjoint::NumberText(answer.rmse),
        warmjoint::NumberText(answer.fit),
        ReplayCommand(suite, answer.unit, kRun)};
    // the variant stands behind the realization where there are variants
    if (suite.ladder) {
      const auto variant = static_cast<std::size_t>(answer.unit.variant);
      row.insert(row.begin() + 1, suite.ladder->variants.at(variant).name);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// The tables of `compare`.
Tree BoardTrees(const Leaderboard& board) {
  Tree tables = {TableTree("Who wins: normalised parameter error, NPE", RankingTable(board)),
                 TableTree("Agreement with the data, medians", AgreementTable(board))};
  // variants beside each other, where there are some
  if (!board.groups.empty()) {
    tables.push_back(TableTree("Rms NPE in each variant, beside its bound", GroupTable(board)));
  }
  const BoardTable parameters = ParameterTable(board);
  if (!parameters.rows.empty()) {
    tables.push_back(TableTree("Each parameter beside its Cramér-Rao bound", parameters));
  }
  return tables;
}

}  // namespace

std::vector<Extreme> ExtremesOf(const RunRow& row) {
  // realizations that have numbers
  std::vector<Extreme> answered;
  for (Eigen::Index i = 0; i < row.npe.size(); ++i) {
    if (std::isnan(row.npe[i])) continue;
    answered.push_back({"", {row.variant[i], row.realization[i]}, row.npe[i]});
  }
  // equal errors in the order of units, so that the choice is the same on every machine
  std::stable_sort(answered.begin(), answered.end(),
                   [](const Extreme& a, const Extreme& b) { return a.npe < b.npe; });

  std::vector<Extreme> extremes;
  // no realization is shown twice
  const auto take = [&](const char* rank, std::size_t at) {
    const bool taken = std::any_of(extremes.begin(), extremes.end(), [&](const Extreme& one) {
      return one.unit == answered[at].unit;
    });
    if (!taken) extremes.push_back({rank, answered[at].unit, answered[at].npe});
  };
  if (answered.empty()) return extremes;
  take("best", 0);
  take("median", (answered.size() - 1) / 2);
  take("worst", answered.size() - 1);
  return extremes;
}

Figure ExtremesFigure(const std::string& label, const std::vector<ReplayedExtreme>& replayed) {
  constexpr double kRow = 200;  // points
  Figure figure = WithoutPanels(
      {"extremes", "Torque and fit of the best, the median and the worst realization",
       fmt::format("{}, by the NPE of its parameters; simulated once more", label),
       "Left: measured torque in the direction of motion with the fit. Right: the last segments as "
       "they were logged. Where even the worst fit follows its torque, the errors of the "
       "parameters are what noise leaves."},
      2);
  // a row for each: its whole recording, and its end close up
  for (const ReplayedExtreme& one : replayed) {
    const Window warm = WarmWindow(one.view);
    AddPanel(
        figure,
        fmt::format("The {}: {}, NPE {}", one.extreme.rank, one.name, PercentText(one.extreme.npe)),
        LevelOverTime(one.view), kRow);
    AddPanel(figure, "Its last segments", CloseUp(one.view, warm, TorqueAxis(one.view, warm, warm)),
             kRow);
  }
  return figure;
}

Tree RunPageData(const RunPage& page) {
  const Leaderboard& board = page.view.board;
  Tree identifiers = Tree::array(), pictures = Tree::array();
  for (const SuiteIdentifier& one : page.suite.identifiers) {
    identifiers.push_back({one.label, WhatItIs(one)});
  }
  for (const Figure& figure : page.figures) pictures.push_back(FigureJson(figure));
  return {{"suite", board.suite},
          {"question", board.question},
          {"verdict", Verdict(board)},
          {"simulated", WhatWasSimulated(page.suite)},
          {"identifiers", std::move(identifiers)},
          {"boards", BoardTrees(board)},
          {"extremes", page.extremes ? FigureJson(*page.extremes) : Tree()},
          {"without_extremes", page.without_extremes},
          {"every", page.view.listing.every},
          {"realizations",
           TableTree("Every answer; a click on a heading sorts", RealizationTable(page))},
          {"figures", std::move(pictures)},
          {"notes", Notes(board)},
          {"terms", kRunTerms},
          {"run", kRun},
          {"finished", board.finished},
          {"all", board.realizations},
          {"versions", page.description.versions},
          {"suite_yaml", page.description.suite_yaml},
          {"board", Tree::parse(BoardToJson(board))}};
}

}  // namespace warmjoint::figures
