// Fit, FPE, RMSE and MAE, as in the paper's Figs. 11 and 12.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "tools/report/draw/ticks.h"
#include "tools/report/figures/axes.h"
#include "tools/report/run/quartiles.h"
#include "tools/report/run/run_figures.h"

namespace warmjoint::report {
namespace {

/// A bar at each median with a line from quartile to quartile.
Plot BarsOf(const std::vector<const RunRow*>& rows, Eigen::VectorXd RunRow::*values,
            const std::string& label) {
  Plot plot;
  std::vector<std::string> names;
  std::vector<Eigen::VectorXd> shown;
  for (const RunRow* row : rows) {
    const QuartileCurve middle = QuartilesOf(Eigen::VectorXd::Zero(1), row->*values);
    const Eigen::VectorXd x = Eigen::VectorXd::Constant(1, static_cast<double>(names.size()));
    plot.series.push_back({"", IdentifierHue(row->identifier), Bars{x, middle.median, 0.6}});
    plot.series.push_back({"", Hue::text,
                           Line{Eigen::Vector2d::Constant(x[0]),
                                Eigen::Vector2d(middle.q25[0], middle.q75[0]), 1.4}});
    names.push_back(row->label);
    shown.insert(shown.end(), {middle.median, middle.q75});
  }
  plot.x = CategoryAxis("", names);
  plot.y = ZeroAxis(label, shown);
  return plot;
}

std::string Finding(const std::vector<const RunRow*>& rows, const std::string& unit) {
  std::string text = "Medians:";
  for (const RunRow* row : rows) {
    const double fit = QuartilesOf(Eigen::VectorXd::Zero(1), row->fit).median[0];
    const double rmse = QuartilesOf(Eigen::VectorXd::Zero(1), row->rmse).median[0];
    text += fmt::format(" {} fits {:.1f} % with RMSE {} {},", row->label, fit,
                        SignificantText(rmse), unit);
  }
  text.back() = '.';
  return text;
}

}  // namespace

std::optional<Figure> AgreementBars(const RunView& run) {
  std::vector<const RunRow*> rows;
  for (const RunRow& row : run.rows) {
    if (row.rmse.array().isFinite().any()) rows.push_back(&row);
  }
  if (rows.empty()) return std::nullopt;

  Figure figure;
  figure.name = "agreement";
  figure.title = "Agreement with the data";
  figure.subtitle =
      RunSubtitle(run, "bars are medians, dark lines reach from quartile to quartile");
  figure.finding = Finding(rows, run.torque_unit);
  figure.width = std::max(720, 160 + 220 * static_cast<int>(rows.size()));
  figure.height = 560;
  figure.rows = figure.columns = {1, 1};
  const std::string unit = run.torque_unit;
  figure.panels = {
      {"Fit", BarsOf(rows, &RunRow::fit, "Fit (%)"), 0, 0},
      {"Final prediction error", BarsOf(rows, &RunRow::fpe, fmt::format("FPE (({})²)", unit)), 0,
       1},
      {"Root mean square error", BarsOf(rows, &RunRow::rmse, fmt::format("RMSE ({})", unit)), 1, 0},
      {"Mean absolute error", BarsOf(rows, &RunRow::mae, fmt::format("MAE ({})", unit)), 1, 1},
  };
  return figure;
}

}  // namespace warmjoint::report
