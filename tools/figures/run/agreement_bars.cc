// Fit, FPE, RMSE and MAE, as in the paper's Figs. 11 and 12.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "tools/board/statistics.h"
#include "tools/figures/axes.h"
#include "tools/figures/run/run_figures.h"
#include "tools/figures/symbols.h"

namespace warmjoint::figures {
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
            const std::string& label, const Rung& rung) {
  Plot plot;
  std::vector<std::string> names;
  std::vector<Eigen::VectorXd> shown;
  for (const RunRow* row : rows) {
    const QuartileCurve middle =
        QuartilesOf(Eigen::VectorXd::Zero(1), At(*row, row->*values, rung));
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

std::string Finding(const RunView& run, const std::vector<const RunRow*>& rows) {
  std::string text = "Medians:";
  for (const Rung& rung : RungsOf(run)) {
    if (rung) text += fmt::format(" with {}", RungName(run, rung));
    for (const RunRow* row : rows) {
      const auto median = [&](const Eigen::VectorXd& values) {
        return MedianOfKnown(At(*row, values, rung));
      };
      text += fmt::format(" {} fits {:.1f} % with RMSE {} {},", row->label, median(row->fit),
                          SignificantText(median(row->rmse)), run.torque_unit);
    }
    text.back() = ';';
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

  // names of many rows need the whole width
  Figure figure = WithoutPanels(
      {"agreement", "Agreement with the data",
       RungsSubtitle(run, "bars are medians, dark lines reach from quartile to quartile"),
       Finding(run, rows)},
      rows.size() > kMostBeside ? 1 : 2);
  const std::string unit = run.torque_unit;
  // measures of the same fit, at each variant by itself
  const std::vector<Rung> rungs = RungsOf(run);
  for (const Rung& rung : rungs) {
    const std::string name = RungName(run, rung);
    const auto add = [&](const std::string& title, Eigen::VectorXd RunRow::*values,
                         const std::string& label) {
      AddPanel(figure, name.empty() ? title : name + ": " + title,
               BarsOf(rows, values, label, rung), 240);
    };
    add("Fit", &RunRow::fit, "Fit (%)");
    if (!rung) add("Final prediction error", &RunRow::fpe, fmt::format("FPE ({})", SquareOf(unit)));
    add("Root mean square error", &RunRow::rmse, fmt::format("RMSE ({})", unit));
    // what FPE and MAE say, Fit and RMSE of many rungs have said
    if (!rung) add("Mean absolute error", &RunRow::mae, fmt::format("MAE ({})", unit));
  }
  return figure;
}

}  // namespace warmjoint::figures
