// Parameter error against the variable that a suite's ladder climbs.
#include <fmt/core.h>

#include <cmath>

#include "tools/report/draw/ticks.h"
#include "tools/report/figures/axes.h"
#include "tools/report/figures/telling_apart.h"
#include "tools/report/run/quartiles.h"
#include "tools/report/run/run_figures.h"

namespace warmjoint::report {
namespace {

/// Quartiles of the row's NPE at each rung, per cent.
QuartileCurve RungsOf(const RunRow& row, const Rungs& rungs) {
  const Eigen::Index count = rungs.values.size();
  QuartileCurve curve{rungs.values, Eigen::VectorXd(count), Eigen::VectorXd(count),
                      Eigen::VectorXd(count)};
  for (Eigen::Index rung = 0; rung < count; ++rung) {
    const Eigen::VectorXd npe =
        (row.variant.array() == static_cast<int>(rung)).select(100 * row.npe, std::nan(""));
    const QuartileCurve one = QuartilesOf(Eigen::VectorXd::Zero(1), npe);
    curve.q25[rung] = one.q25[0];
    curve.median[rung] = one.median[0];
    curve.q75[rung] = one.q75[0];
  }
  return curve;
}

/// The rms NPE at the Cramer-Rao bound of each rung, per cent; NaN where it is not known.
Eigen::VectorXd BoundOf(const RunRow& row, const Rungs& rungs) {
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(row.variant.size());
  for (const ParameterColumn& column : row.parameters) {
    squares += (100 * column.bound.cwiseQuotient(column.truth)).cwiseAbs2();
  }
  Eigen::VectorXd bound(rungs.values.size());
  for (Eigen::Index rung = 0; rung < bound.size(); ++rung) {
    const auto here = row.variant.array() == static_cast<int>(rung);
    const double count = static_cast<double>(here.count());
    bound[rung] = std::sqrt(here.select(squares, 0).sum() / count);
  }
  return row.parameters.empty() ? bound.setConstant(std::nan("")) : bound;
}

std::string Finding(const RunView& run) {
  std::string text =
      fmt::format("Median NPE from the first rung of {} to the last:", run.rungs.variable);
  for (const RunRow& row : run.rows) {
    const QuartileCurve curve = RungsOf(row, run.rungs);
    text += fmt::format(" {} {} to {} %,", row.label, SignificantText(curve.median[0]),
                        SignificantText(curve.median.tail(1)[0]));
  }
  text.back() = '.';
  return text;
}

}  // namespace

std::optional<Figure> LadderFigure(const RunView& run) {
  const Rungs& rungs = run.rungs;
  if (rungs.values.size() < 2 || run.rows.empty()) return std::nullopt;

  Plot plot;
  std::vector<Eigen::VectorXd> shown;
  std::vector<Series> lines;
  for (std::size_t i = 0; i < run.rows.size(); ++i) {
    const RunRow& row = run.rows[i];
    const Hue hue = IdentifierHue(row.identifier);
    const QuartileCurve curve = RungsOf(row, rungs);
    plot.series.push_back({"", hue, Band{curve.x, curve.q25, curve.q75}});
    lines.push_back({row.label, hue, Line{curve.x, curve.median, 1.8, DashOf(run.rows, i)}});
    lines.push_back({"", hue, Scatter{curve.x, curve.median, 3, MarkerOf(run.rows, i)}});
    shown.insert(shown.end(), {curve.q25, curve.median, curve.q75});
  }
  if (!std::isfinite(RangeOf(shown).first)) return std::nullopt;
  plot.series.insert(plot.series.end(), lines.begin(), lines.end());
  const Eigen::VectorXd bound = BoundOf(run.rows.front(), rungs);
  if (bound.allFinite()) {
    plot.series.push_back(
        {"Cramér-Rao bound (rms)", Hue::text, Line{rungs.values, bound, 1.2, Dash::dashed}});
    shown.push_back(bound);
  }

  const std::string unit = rungs.unit.empty() ? "" : fmt::format(" ({})", UnitText(rungs.unit));
  const bool wide =
      rungs.values.minCoeff() > 0 && rungs.values.maxCoeff() > 10 * rungs.values.minCoeff();
  plot.x = rungs.names.empty() ? (wide ? LogarithmicAxis(rungs.variable + unit, {rungs.values})
                                       : LinearAxis(rungs.variable + unit, {rungs.values}))
                               : CategoryAxis("", rungs.names);
  plot.y = MagnitudeAxis("NPE, continuous (%)", shown);

  Figure figure;
  figure.name = "ladder";
  figure.title = rungs.names.empty() ? fmt::format("Parameter error against {}", rungs.variable)
                                     : "Parameter error in each variant";
  figure.subtitle =
      fmt::format("{}: {} realizations; lines are medians, bands reach from quartile to quartile",
                  run.suite, run.realizations);
  figure.finding = Finding(run);
  figure.width = 720;
  figure.height = 440;
  figure.panels.push_back({"", plot});
  return figure;
}

}  // namespace warmjoint::report
