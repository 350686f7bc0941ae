#include "tools/report/page/log_page.h"

#include <fmt/format.h>

#include "tools/report/draw/ticks.h"
#include "tools/report/estimate/remarks.h"
#include "tools/report/estimate/shown_parameters.h"
#include "tools/report/figures/axes.h"
#include "tools/report/figures/fit_panels.h"
#include "tools/report/figures/log_figure.h"
#include "tools/report/figures/predicted.h"
#include "tools/report/page/chart_library.h"
#include "tools/report/page/html.h"
#include "tools/report/page/log_chart.h"
#include "tools/report/page/plain_words.h"
#include "tools/report/page/style.h"

namespace warmjoint::report {
namespace {

using BoardTable = warmjoint::Table;

bool Passed(const FitView& view) { return view.estimate.status == Status::ok; }

std::string List(const std::vector<std::string>& items) {
  std::string html;
  for (const std::string& item : items) html += "<li>" + Escape(InPrint(item)) + "</li>\n";
  return "<ul>\n" + html + "</ul>\n";
}

std::string VerdictSection(const FitView& view) {
  std::string html = Paragraph(
      Passed(view) ? "The numbers below passed every test that this log allows."
                   : "The numbers below are void: they are shown so that you can see why.");
  html += List(Remarks(view.estimate));
  // how well the fit explains the samples that it saw
  if (view.estimate.metrics) {
    const Metrics& metrics = *view.estimate.metrics;
    html += Paragraph(
        fmt::format("The fit explains {:.1f} % of the torque's variation (Fit); its typical error "
                    "is {} {} (RMSE), "
                    "over {} samples.",
                    metrics.fit, SignificantText(metrics.rmse), view.torque_unit, metrics.n));
  }
  // and how well it does on others
  if (view.estimate.holdout) {
    html += Paragraph(
        fmt::format("On samples that were held out of a second fit, the typical error is {} {}.",
                    SignificantText(view.estimate.holdout->rmse), view.torque_unit));
  }
  return html;
}

/// What a reader does now: how to use numbers that passed, or what to record and try.
std::string NextSection(const LogPage& page) {
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
  return steps.empty() ? Paragraph("Nothing is left to do.") : List(steps);
}

std::string ParametersSection(const FitView& view) {
  if (view.estimate.parameters.empty()) {
    return Paragraph("There are no numbers that could be given.");
  }

  // the same rows as in the picture, with the names that estimate.json has
  const Table drawn = ParametersOf(view);
  BoardTable table{{"parameter", "value", "95 % interval", "unit"}, {}};
  for (std::size_t i = 1; i < drawn.rows.size(); ++i) table.rows.push_back(drawn.rows[i]);
  const std::vector<EstimatedParameter> shown = ShownParameters(view.estimate);
  for (std::size_t i = 0; i < shown.size(); ++i) table.rows[i][0] = shown[i].name;
  return HtmlTable(
      Passed(view) ? "Parameters of the friction" : "Void: parameters of a fit that failed", table);
}

std::string TestsSection(const FitView& view) {
  BoardTable table{{"question", "answer", "size", "p"}, {}};
  // a line for each question: its answer, how much it explains, how often chance does as much
  for (const Diagnostic& diagnostic : view.estimate.diagnostics) {
    const bool made = diagnostic.made;
    table.rows.push_back({QuestionOf(diagnostic.test),
                          !made                 ? "not asked: " + diagnostic.reason
                          : diagnostic.rejected ? "yes"
                                                : "no",
                          made ? fmt::format("{} {}", SignificantText(diagnostic.effect, 2),
                                             UnitText(diagnostic.effect_unit))
                               : "–",
                          made ? fmt::format("{:.2g}", diagnostic.p_adjusted) : "–"});
  }
  if (table.rows.empty()) return Paragraph("No test was made: there is no fit to test.");
  return Paragraph(
             "A complete model leaves a residual that depends on nothing. Each line asks whether "
             "it does. Size: what would be explained, rms. p: how often chance alone does as much, "
             "with the number of questions counted.") +
         HtmlTable("What the residual still shows", table);
}

std::string AssumptionsSection(const FitView& view) {
  std::vector<std::string> items;
  for (const Assumption& assumption : view.estimate.assumptions) {
    // the assumption in plain words, with what it means here
    std::string text = AssumptionOf(assumption.name);
    if (!assumption.meaning.empty()) text += " (" + assumption.meaning + ")";
    // how much the numbers rest on it
    for (const auto& [parameter, move] : assumption.moves) {
      text += fmt::format("; {} would change by {}", parameter, SignificantText(move, 2));
    }
    items.push_back(text + ".");
  }
  return items.empty() ? Paragraph("None beyond the model itself.") : List(items);
}

std::string MujocoSection(const FitView& view) {
  if (!Passed(view) || !view.estimate.friction) {
    return Paragraph(
        "A void fit belongs into no simulation. Once a fit passes, "
        "`warmjoint attach` puts its friction onto a joint of your robot.");
  }
  return Paragraph(
             "With estimate.json as identify writes it; the result loads wherever MuJoCo 4.0 and "
             "the plugin are:") +
         "<pre>warmjoint attach robot.xml --joint JOINT=estimate.json -o robot_warm.xml</pre>\n";
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
  Figure residuals;
  residuals.name = "residuals";
  residuals.title = "What the fit leaves";
  residuals.finding =
      "Residuals over time, position and velocity, and their correlation over lag: a "
      "complete model leaves none of them a pattern.";
  // four panels, two to a row
  residuals.height = 0;
  residuals.rows = {200, 200};
  residuals.columns = {1, 1};
  residuals.panels = {{"Over time", ResidualsOver(view, Against::time), 0, 0},
                      {"Over velocity", ResidualsOver(view, Against::velocity), 0, 1},
                      {"Over position", ResidualsOver(view, Against::position), 1, 0},
                      {"Correlation over lag", ResidualMemory(view), 1, 1}};
  figures.push_back(residuals);
  if (auto predicted = MakePredicted(view)) figures.push_back(*std::move(predicted));
  return figures;
}

std::string PicturesSection(const FitView& view) {
  std::string html;
  for (const Figure& figure : FiguresOf(view)) html += HtmlPicture(figure);
  return html;
}

std::string RepeatSection(const LogPage& page) {
  std::string commands;
  for (const std::string& command : page.commands) commands += Escape(command) + "\n";
  return "<pre>" + commands +
         "</pre>\n<details><summary>Licence of the charts (dygraphs)</summary>\n<pre>" +
         Escape(ChartLicence()) + "</pre>\n</details>\n";
}

std::string Head(const FitView& view, const std::string& own_style) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n{}"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<link rel=\"icon\" href=\"data:,\">\n<title>{} – warmjoint</title>\n<style>{}</style>\n"
      "<style>{}</style>\n</head>\n<body>\n<a class=\"skip\" href=\"#verdict\">Skip to the "
      "verdict</a>\n"
      "<header>\n<h1>{}</h1>\n<p class=\"question\">warmjoint found the friction of this robot "
      "joint in a "
      "log of its position, velocity and torque, and examined whether the numbers can be used. "
      "Identified by "
      "{}.</p>\n<p class=\"verdict{}\">{}</p>\n",
      ChartSecurityPolicy({ChartScript(), LogChartScript()}), Escape(view.source), kStyle,
      own_style, Escape(view.source), Escape(view.estimate.identifier), Passed(view) ? "" : " void",
      Escape(VerdictSentence(view) + "."));
}

}  // namespace

std::string MakeLogPage(const LogPage& page) {
  const FitView& view = page.view;
  const std::string own_style = std::string(ChartStyle()) + std::string(LogChartStyle());
  struct Part {
    const char* id;
    const char* heading;
    std::string body;
  };

  // what decides first comes first
  const Part parts[] = {
      {"verdict", Passed(view) ? "Why it passes" : "Why it was refused", VerdictSection(view)},
      {"next", "What to do next", NextSection(page)},
      {"parameters", "Parameters", ParametersSection(view)},
      {"recording", "The recording", MakeLogChart(view)},
      {"pictures", "Pictures", PicturesSection(view)},
      {"tests", "Tests", TestsSection(view)},
      {"assumptions", "Assumptions", AssumptionsSection(view)},
      {"mujoco", "Into MuJoCo", MujocoSection(view)},
      {"terms", "Terms", HtmlTerms(Terms())},
      {"repeat", "How to repeat it", RepeatSection(page)}};

  // a link to each part in front of them all
  std::string links, body;
  for (const Part& part : parts) {
    links += fmt::format("<li><a href=\"#{}\">{}</a></li>", part.id, part.heading);
    body += Section(part.id, part.heading, part.body);
  }
  return Head(view, own_style) + "<nav aria-label=\"On this page\"><ul>" + links +
         "</ul></nav>\n</header>\n<main>\n" + body + "</main>\n<script>" +
         std::string(ChartScript()) + "</script>\n<script>" + std::string(LogChartScript()) +
         "</script>\n</body>\n</html>\n";
}

}  // namespace warmjoint::report
