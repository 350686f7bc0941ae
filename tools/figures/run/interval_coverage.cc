// How often 95 % intervals hold the truth.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "tools/figures/axes.h"
#include "tools/figures/run/run_figures.h"
#include "tools/figures/symbols.h"

namespace warmjoint::figures {
namespace {

/// 95 % interval of a share (Wilson 1927), in per cent.
std::pair<double, double> ShareInterval(int hits, int tries) {
  constexpr double kZ = 1.96;
  const double n = tries, share = hits / n;
  const double centre = (share + kZ * kZ / (2 * n)) / (1 + kZ * kZ / n);
  const double reach =
      kZ * std::sqrt(share * (1 - share) / n + kZ * kZ / (4 * n * n)) / (1 + kZ * kZ / n);
  return {100 * std::max(0.0, centre - reach), 100 * std::min(1.0, centre + reach)};
}

/// Adds one identifier's shares beside the others'. names: of the parameters along the axis. Returns the lowest
/// end of an interval of a share, per cent.
double AddShares(Plot& plot, const RunRow& row, const std::vector<std::string>& names,
                 double offset, Marker marker) {
  std::vector<double> x, y;
  double lowest = 100;
  // a dot at the share of intervals that hold the truth, with the 95 % interval of that share
  for (const ParameterColumn& column : row.parameters) {
    if (column.intervals == 0) continue;
    const auto place = std::ranges::find(names, column.name) - names.begin();
    const double at = static_cast<double>(place) + offset;
    const auto [lower, upper] = ShareInterval(column.covered, column.intervals);
    plot.series.push_back({"", IdentifierHue(row.identifier),
                           Line{Eigen::Vector2d(at, at), Eigen::Vector2d(lower, upper), 1.5}});
    x.push_back(at);
    y.push_back(100.0 * column.covered / column.intervals);
    lowest = std::min(lowest, lower);
  }
  // the dots of an identifier are one series, which the legend names
  plot.series.push_back(
      {row.label, IdentifierHue(row.identifier), Scatter{VectorOf(x), VectorOf(y), 4, marker}});
  return lowest;
}

bool GivesIntervals(const RunRow& row) {
  return std::any_of(row.parameters.begin(), row.parameters.end(),
                     [](const ParameterColumn& column) { return column.intervals > 0; });
}

/// The parameters that any row gives an interval of.
std::vector<std::string> NamesOf(const std::vector<RunRow>& rows) {
  std::vector<std::string> names;
  for (const RunRow& row : rows) {
    for (const ParameterColumn& column : row.parameters) {
      const bool is_new = std::ranges::find(names, column.name) == names.end();
      if (column.intervals > 0 && is_new) names.push_back(column.name);
    }
  }
  return names;
}

std::string Finding(const std::vector<RunRow>& rows) {
  std::string text = "95 % intervals:";
  for (const RunRow& row : rows) {
    // the worst and the best parameter of each identifier
    double least = 100, most = 0;
    for (const ParameterColumn& column : row.parameters) {
      if (column.intervals == 0) continue;
      const double share = 100.0 * column.covered / column.intervals;
      least = std::min(least, share);
      most = std::max(most, share);
    }
    text +=
        fmt::format(" those of {} hold the truth in {:.0f} to {:.0f} % of the runs, by parameter,",
                    row.label, least, most);
  }
  text.back() = '.';
  return text;
}

}  // namespace

std::optional<Figure> IntervalCoverage(const RunView& run) {
  // only identifiers that give intervals
  std::vector<RunRow> rows;
  for (const RunRow& row : run.rows) {
    if (GivesIntervals(row)) rows.push_back(row);
  }
  if (rows.empty()) return std::nullopt;

  Plot plot;
  double lowest = 90;  // per cent
  // identifiers stand side by side at each parameter
  const std::vector<std::string> names = NamesOf(rows);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double middle = (static_cast<double>(rows.size()) - 1) / 2;
    const double offset = 0.16 * (static_cast<double>(i) - middle);
    lowest = std::min(lowest, AddShares(plot, rows[i], names, offset, MarkerOf(rows, i)));
  }
  // the line that good intervals lie on
  plot.series.push_back({"95 %", Hue::text, LevelLine{95}});
  std::vector<std::string> symbols;
  for (const std::string& name : names) symbols.push_back(SymbolOf(name));
  // the axis begins below the lowest interval, and ends so far above 100 that marks there stand whole, but before a number
  // that no share can have
  plot.x = CategoryAxis("parameter", symbols);
  const double lower = std::max(-2.0, lowest - 4);
  plot.y = {"intervals that hold the truth (%)", lower, 100 + std::min(1.9, 0.07 * (100 - lower))};

  // the question that the picture answers is its title
  return SinglePlot(
      {"coverage", "Do 95 % intervals hold the truth?",
       RunSubtitle(
           run,
           "dots: share of intervals that contain the truth; bars: 95 % interval of that share"),
       Finding(rows)},
      plot);
}

}  // namespace warmjoint::figures
