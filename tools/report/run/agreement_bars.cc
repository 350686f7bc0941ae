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

constexpr std::size_t kMostBeside = 5;  // rows in two panels side by side

/// Bars of one identifier are told apart by how faint they are.
double OpacityOf(const std::vector<const RunRow*>& rows, std::size_t place) {
  std::size_t earlier = 0;
  for (std::size_t i = 0; i < place; ++i) earlier += rows[i]->identifier == rows[place]->identifier;
  return std::pow(0.6, static_cast<double>(earlier));
}

/// The square of a unit of torque or force.
std::string SquareOf(const std::string& unit) { return unit == "N·m" ? "N²·m²" : unit + "²"; }

/// Writes each median above its bar. shown: median and upper quartile of each.
void AddNumbers(Plot& plot, const std::vector<Eigen::VectorXd>& shown) {
  constexpr double kRoom = 0.1;  // of the axis, above the highest
  plot.y.upper *= 1 + kRoom;
  // above both the bar and the line that rises from it
  for (std::size_t i = 0; i + 1 < shown.size(); i += 2) {
    const double top = std::max(shown[i][0], shown[i + 1][0]) + 0.05 * plot.y.upper;
    plot.series.push_back(
        {"", Hue::text,
         Note{static_cast<double>(i) / 2, top, SignificantText(shown[i][0], 4), Side::centre}});
  }
}

/// A bar at each median with its number and a line from quartile to quartile.
Plot BarsOf(const std::vector<const RunRow*>& rows, Eigen::VectorXd RunRow::*values,
            const std::string& label) {
  Plot plot;
  std::vector<std::string> names;
  std::vector<Eigen::VectorXd> shown;
  for (const RunRow* row : rows) {
    // the median as a bar, the quartiles as a line through its end
    const QuartileCurve middle = QuartilesOf(Eigen::VectorXd::Zero(1), row->*values);
    const Eigen::VectorXd x = Eigen::VectorXd::Constant(1, static_cast<double>(names.size()));
    const double opacity = OpacityOf(rows, names.size());
    plot.series.push_back(
        {"", IdentifierHue(row->identifier), Bars{x, middle.median, 0.6, opacity}});
    plot.series.push_back({"", Hue::text,
                           Line{Eigen::Vector2d::Constant(x[0]),
                                Eigen::Vector2d(middle.q25[0], middle.q75[0]), 1.4}});
    names.push_back(row->label);
    shown.insert(shown.end(), {middle.median, middle.q75});
  }
  // bars stand on zero, with numbers above them
  plot.x = CategoryAxis("", names);
  plot.y = ZeroAxis(label, shown);
  AddNumbers(plot, shown);
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
  // only identifiers that gave figures of fit
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
  const std::string unit = run.torque_unit;
  // names of many rows need the whole width
  const int across = rows.size() > kMostBeside ? 1 : 2;
  figure.columns.assign(static_cast<std::size_t>(across), 1);
  figure.rows.assign(static_cast<std::size_t>(4 / across), 240);
  figure.height = 0;
  // four measures of the same fit
  figure.panels = {
      {"Fit", BarsOf(rows, &RunRow::fit, "Fit (%)"), 0, 0},
      {"Final prediction error",
       BarsOf(rows, &RunRow::fpe, fmt::format("FPE ({})", SquareOf(unit))), 0, 1},
      {"Root mean square error", BarsOf(rows, &RunRow::rmse, fmt::format("RMSE ({})", unit)), 1, 0},
      {"Mean absolute error", BarsOf(rows, &RunRow::mae, fmt::format("MAE ({})", unit)), 1, 1},
  };
  // panels beside each other, or all below each other
  for (int i = 0; i < 4; ++i) {
    figure.panels[static_cast<std::size_t>(i)].row = i / across;
    figure.panels[static_cast<std::size_t>(i)].column = i % across;
  }
  return figure;
}

}  // namespace warmjoint::report
