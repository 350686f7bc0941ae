#include "tools/figures/log_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "identification/lack_of_fit/table.h"
#include "tools/figures/axes.h"
#include "tools/figures/estimate_figures.h"
#include "tools/figures/fit_panels.h"
#include "tools/figures/reduce.h"
#include "tools/figures/shown_estimate.h"
#include "tools/figures/symbols.h"

namespace warmjoint::figures {
namespace {

/// The question that a test for lack of fit asks; its name where it is not known.
std::string QuestionOf(const std::string& test) {
  const LackOfFitTest* row = FindLackOfFitTest(test);
  return row ? std::string(row->question) : test;
}

/// What helps where the answer is yes: another model, or another log.
std::string RemedyOf(const std::string& test) {
  const LackOfFitTest* row = FindLackOfFitTest(test);
  if (row) return std::string(row->advice);
  return "The residual shows " + test + ": look at its pictures.";
}

/// Terms of a page with their meaning.
constexpr auto kTerms = std::to_array<std::pair<const char*, const char*>>({
    {"friction", "The torque that motion costs, against its direction. It falls as grease warms."},
    {"viscous, coulomb",
     "Friction that grows with speed (N·m for each rad/s), and that which does not (N·m)."},
    {"thermal_gain, thermal_time_constant",
     "By how much each watt of the joint's own heat changes friction, and how long that takes. E "
     "is the change that is reached; no thermometer is needed."},
    {"kept samples",
     "Samples at a constant speed: there the torque is friction, and gravity where it acts."},
    {"residual", "Measured torque less fitted torque."},
    {"95 % interval",
     "A range that holds the true value in 95 of 100 such logs, if the model is right."},
    {"Fit, RMSE, MAE",
     "1 − norm of the residual over norm of the torque's variation, in per cent; root of the "
     "mean square error; mean absolute error."},
    {"void", "A number of a fit that failed a test. It may look precise and be wrong."},
});

using Eigen::Index;
using Row = std::vector<std::string>;

constexpr int kParts = 2500;      // of a recording whose extremes the page's charts show
constexpr double kNought = 0.05;  // per cent of a parameter that an assumption may move unsaid

bool Passed(const FitView& view) { return view.estimate.status == Status::ok; }

/// How well the fit describes the samples that it saw, and others.
std::vector<std::string> AgreementOf(const FitView& view) {
  std::vector<std::string> sentences;
  if (const auto& metrics = view.estimate.metrics) {
    sentences.push_back(fmt::format(
        "Fit {:.1f} % (1 − norm of the residual over norm of the torque's variation); RMSE {} {}, "
        "the root of the mean square error, over {} samples.",
        metrics->fit, SignificantText(metrics->rmse), view.torque_unit, metrics->n));
  }
  if (view.estimate.holdout) {
    sentences.push_back(
        fmt::format("On samples that were held out of a second fit, the RMSE is {} {}.",
                    SignificantText(view.estimate.holdout->rmse), view.torque_unit));
  }
  return sentences;
}

/// What a reader does now: how to use numbers that passed, or what to record and try.
std::vector<std::string> NextSteps(const LogPage& page) {
  std::vector<std::string> steps;
  // first what is wrong with the log itself
  for (const std::string& fault : page.check.faults) steps.push_back("The log: " + fault + ".");
  // then how to use the numbers, or a remedy for each test that failed
  if (Passed(page.view)) {
    steps.push_back("Use the numbers with their intervals; keep the assumptions below in mind.");
  } else {
    for (const Diagnostic& diagnostic : page.view.estimate.diagnostics) {
      if (diagnostic.rejected) steps.push_back(RemedyOf(diagnostic.test));
    }
  }
  // last what the motion was too poor to tell
  for (const Excitation& excitation : page.check.excitation) {
    if (!excitation.sufficient) {
      steps.push_back(fmt::format("To identify {}: {}", excitation.what, excitation.reason));
    }
  }
  return steps;
}

Tree TableTree(const std::string& caption, const Row& header, const std::vector<Row>& rows) {
  if (rows.empty()) return nullptr;
  return {{"caption", caption}, {"header", header}, {"rows", rows}};
}

Tree ParametersTable(const FitView& view) {
  // the same rows as in the picture, with the names that estimate.json has
  std::vector<Row> rows = ParametersOf(view).rows;
  if (view.estimate.parameters.empty() || rows.empty()) return nullptr;
  rows.erase(rows.begin());
  const std::vector<EstimatedParameter> shown = ShownParameters(view.estimate);
  for (std::size_t i = 0; i < shown.size(); ++i) rows[i][0] = shown[i].name;
  return TableTree(
      Passed(view) ? "Parameters of the friction" : "Void: parameters of a fit that failed",
      {"parameter", "value", "95 % interval", "unit"}, rows);
}

Tree TestsTable(const FitView& view) {
  std::vector<Row> rows;
  // a line for each question: its answer, how much it explains, how often chance does as much
  for (const Diagnostic& diagnostic : view.estimate.diagnostics) {
    const bool made = diagnostic.made;
    rows.push_back({QuestionOf(diagnostic.test),
                    !made                 ? "not asked: " + diagnostic.reason
                    : diagnostic.rejected ? "yes"
                                          : "no",
                    made ? fmt::format("{} {}", SignificantText(diagnostic.effect, 2),
                                       UnitText(diagnostic.effect_unit))
                         : "–",
                    made ? fmt::format("{:.2g}", diagnostic.p_adjusted) : "–"});
  }
  return TableTree("What the residual still shows", {"question", "answer", "size", "p"}, rows);
}

/// By how much the assumption moves the parameter, per cent of it; 0 where that is not known.
double MoveOf(const Assumption& assumption, const EstimatedParameter& parameter) {
  for (const auto& [name, move] : assumption.moves) {
    if (name == parameter.name && parameter.value != 0) return 100 * move / parameter.value;
  }
  return 0;
}

/// A row for each assumption that moves something, a column for each parameter that one moves.
Tree AssumptionsTable(const Estimate& estimate) {
  std::vector<EstimatedParameter> moved = ShownParameters(estimate);
  std::erase_if(moved, [&](const EstimatedParameter& parameter) {
    return std::ranges::none_of(estimate.assumptions, [&](const Assumption& assumption) {
      return std::abs(MoveOf(assumption, parameter)) >= kNought;
    });
  });
  Row header{"taken for granted"};
  for (const EstimatedParameter& parameter : moved) header.push_back(parameter.name);
  std::vector<Row> rows;
  for (const Assumption& assumption : estimate.assumptions) {
    Row row{assumption.meaning.empty() ? assumption.name : AsSentence(assumption.meaning)};
    bool any = false;
    for (const EstimatedParameter& parameter : moved) {
      const double move = MoveOf(assumption, parameter);
      const bool counts = std::abs(move) >= kNought;
      any = any || counts;
      row.push_back(counts ? fmt::format("{}{} %", move > 0 ? "+" : "", SignificantText(move, 2))
                           : "–");
    }
    if (any) rows.push_back(std::move(row));
  }
  return TableTree("Change of each parameter, per cent of its value, were that not so", header,
                   rows);
}

/// The pictures, the ones that decide first.
std::vector<Figure> FiguresOf(const FitView& view) {
  // the log, whatever became of it
  std::vector<Figure> figures{MakeLogFigure(view)};
  if (view.selection.count() == 0) return figures;

  // what was measured, with the fit where there is one
  const std::string void_note = view.is_void() ? " (void)" : "";
  figures.push_back(SinglePlot({"level", "Level of friction over time" + void_note, "",
                                "Torque in the direction of motion, measured and fitted."},
                               LevelOverTime(view)));
  figures.push_back(SinglePlot({"friction_curve", "Friction over velocity" + void_note, "",
                                "Each dot is a kept sample; lines are the fitted law."},
                               FrictionCurve(view)));
  if (!view.has_fit) return figures;
  if (view.warms()) {
    figures.push_back(SinglePlot(
        {"warm_up", "Warm-up" + void_note, "", "How the friction changes by its own heat, E."},
        WarmUpCurve(view)));
  }

  // what the fit leaves, on samples that it has seen and on others
  Figure residuals = WithoutPanels(
      {"residuals", "What the fit leaves", "",
       "Residuals over time, position and velocity, and their correlation over lag: a "
       "complete model leaves none of them a pattern."},
      2);
  AddPanel(residuals, "Over time", ResidualsOver(view, SeenOver::time), 200);
  AddPanel(residuals, "Over velocity", ResidualsOver(view, SeenOver::velocity), 200);
  AddPanel(residuals, "Over position", ResidualsOver(view, SeenOver::position), 200);
  AddPanel(residuals, "Correlation over lag", ResidualMemory(view), 200);
  figures.push_back(residuals);
  if (auto predicted = MakePredicted(view)) figures.push_back(*std::move(predicted));
  return figures;
}

/// Samples that show every extreme of every column.
std::vector<Index> Thinned(const FitView& view, const Eigen::VectorXd& torque) {
  const CellSpan parts{view.time[0], view.time.tail(1)[0], kParts};
  std::vector<Index> chosen;
  for (const Eigen::VectorXd* column : {&view.position, &view.velocity, &torque}) {
    const std::vector<Index> own = ReduceCurve(view.time, *column, parts);
    std::vector<Index> both;
    std::set_union(chosen.begin(), chosen.end(), own.begin(), own.end(), std::back_inserter(both));
    chosen = std::move(both);
  }
  return chosen;
}

/// Rounded to five digits, which a chart cannot show.
Tree Rounded(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::stod(fmt::format("{:.5g}", value));
}

/// time, position, velocity, torque as it was logged, fit and whether it is kept, of each sample.
Tree SamplesOf(const FitView& view) {
  const Eigen::VectorXd torque = view.torque + view.rigid;
  Tree rows = Tree::array();
  for (const Index i : Thinned(view, torque)) {
    const bool kept = view.selection.keep[i];
    const double fit = view.has_fit && kept ? view.fitted[i] + view.rigid[i] : std::nan("");
    rows.push_back({std::stod(fmt::format("{:.7g}", view.time[i])), Rounded(view.position[i]),
                    Rounded(view.velocity[i]), Rounded(torque[i]), Rounded(fit), kept ? 1 : 0});
  }
  return rows;
}

}  // namespace

Tree LogPageData(const LogPage& page) {
  const FitView& view = page.view;
  Tree pictures = Tree::array();
  for (const Figure& figure : FiguresOf(view)) pictures.push_back(FigureJson(figure));
  Tree samples = SamplesOf(view);
  const bool thinned = static_cast<Index>(samples.size()) < view.time.size();
  return {{"source", view.source},
          {"identifier", view.estimate.identifier},
          {"passed", Passed(view)},
          {"verdict", VerdictSentence(view)},
          {"remarks", Remarks(view.estimate)},
          {"agreement", AgreementOf(view)},
          {"next", NextSteps(page)},
          {"parameters", ParametersTable(view)},
          {"tests", TestsTable(view)},
          {"assumptions", AssumptionsTable(view.estimate)},
          {"attachable", Passed(view) && view.estimate.friction.has_value()},
          {"terms", kTerms},
          {"commands", page.commands},
          {"thinned", thinned},
          {"samples", std::move(samples)},
          {"charts", {PositionLabel(view), SpeedLabel(view), TorqueLabel(view, "torque")}},
          {"figures", std::move(pictures)}};
}

}  // namespace warmjoint::figures
