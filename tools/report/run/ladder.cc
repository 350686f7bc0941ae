// Parameter error against the variable that a suite's ladder climbs.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "tools/report/draw/ticks.h"
#include "tools/report/figures/axes.h"
#include "tools/report/figures/telling_apart.h"
#include "tools/report/run/quartiles.h"
#include "tools/report/run/run_figures.h"

namespace warmjoint::report {
namespace {

/// The row's NPE at one rung, NaN at the others, per cent, [R].
Eigen::VectorXd AtRung(const RunRow& row, Eigen::Index rung) {
  return (row.variant.array() == static_cast<int>(rung)).select(100 * row.npe, std::nan(""));
}

/// Quartiles of the row's NPE at each rung, per cent.
QuartileCurve RungsOf(const RunRow& row, const Rungs& rungs) {
  const Eigen::Index count = rungs.values.size();
  QuartileCurve curve{rungs.values, Eigen::VectorXd(count), Eigen::VectorXd(count),
                      Eigen::VectorXd(count)};
  for (Eigen::Index rung = 0; rung < count; ++rung) {
    const QuartileCurve one = QuartilesOf(Eigen::VectorXd::Zero(1), AtRung(row, rung));
    curve.q25[rung] = one.q25[0];
    curve.median[rung] = one.median[0];
    curve.q75[rung] = one.q75[0];
  }
  return curve;
}

/// The rms NPE at the Cramer-Rao bound of each rung, per cent, over the realizations where it is
/// known; NaN where it never is.
Eigen::VectorXd BoundOf(const RunRow& row, const Rungs& rungs) {
  // squared relative bounds of each realization, summed over its parameters, per cent
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(row.variant.size());
  for (const ParameterColumn& column : row.parameters) {
    squares += (100 * column.bound.cwiseQuotient(column.truth)).cwiseAbs2();
  }
  // their root mean square over the realizations of each rung
  Eigen::VectorXd bound(rungs.values.size());
  for (Eigen::Index rung = 0; rung < bound.size(); ++rung) {
    const auto here = row.variant.array() == static_cast<int>(rung) && squares.array().isFinite();
    const double count = static_cast<double>(here.count());
    bound[rung] = std::sqrt(here.select(squares, 0).sum() / count);
  }
  return row.parameters.empty() ? bound.setConstant(std::nan("")) : bound;
}

/// The rms NPE of every row at every rung, which stands beside the bound, as the median does not.
Scatter MeansOf(const RunView& run) {
  const Eigen::Index count = run.rungs.values.size();
  const auto rows = static_cast<Eigen::Index>(run.rows.size());
  Scatter means{Eigen::VectorXd(count * rows), Eigen::VectorXd(count * rows), 3, Marker::diamond};
  for (Eigen::Index i = 0; i < rows; ++i) {
    for (Eigen::Index rung = 0; rung < count; ++rung) {
      means.x[i * count + rung] = run.rungs.values[rung];
      means.y[i * count + rung] =
          RootMeanSquare(AtRung(run.rows[static_cast<std::size_t>(i)], rung));
    }
  }
  return means;
}

/// " energy-ml 0.107 to 10.7 %," along the ladder; " energy-ml 0.84 % (ladder) to 8.7 % (slow),"
/// where variants have names alone.
std::string RangeText(const std::string& label, const Eigen::VectorXd& median,
                      const std::vector<std::string>& names) {
  // rungs in order have a first and a last
  if (names.empty()) {
    return fmt::format(" {} {} to {} %,", label, SignificantText(median[0]),
                       SignificantText(median.tail(1)[0]));
  }
  // variants have a best and a worst
  if (!median.array().isFinite().any()) return fmt::format(" {} none,", label);
  Eigen::Index best = 0, worst = 0;
  median.minCoeff<Eigen::PropagateNumbers>(&best);
  median.maxCoeff<Eigen::PropagateNumbers>(&worst);
  return fmt::format(" {} {} % ({}) to {} % ({}),", label, SignificantText(median[best]),
                     names[static_cast<std::size_t>(best)], SignificantText(median[worst]),
                     names[static_cast<std::size_t>(worst)]);
}

/// "torque noise" for noise.torque, "controller bandwidth" for controller.bandwidth.
std::string VariableName(std::string variable) {
  const std::string noise = "noise.";
  if (variable.starts_with(noise)) variable = variable.substr(noise.size()) + " noise";
  for (char& letter : variable) {
    if (letter == '.' || letter == '_') letter = ' ';
  }
  return variable;
}

std::string Finding(const RunView& run, const std::vector<std::string>& silent) {
  const Rungs& rungs = run.rungs;
  std::string text = rungs.names.empty()
                         ? fmt::format("Median NPE from the first rung of {} to the last:",
                                       VariableName(rungs.variable))
                         : "Median NPE in the best and the worst variant:";
  for (const RunRow& row : run.rows) {
    text += RangeText(row.label, RungsOf(row, rungs).median, rungs.names);
  }
  text.back() = '.';
  // rungs that nobody gave numbers for
  for (const std::string& name : silent) {
    text += fmt::format(" No identifier gives numbers in {}.", name);
  }
  return text;
}

/// Writes "no numbers" over the rungs where no line has a value; returns their names.
std::vector<std::string> MarkSilent(const Rungs& rungs, Plot& plot) {
  std::vector<std::string> silent;
  // the middle of the axis as the eye sees it
  const double middle = plot.y.scale == Scale::logarithmic ? std::sqrt(plot.y.lower * plot.y.upper)
                                                           : (plot.y.lower + plot.y.upper) / 2;
  // a rung without a dot gets words in its place
  for (Eigen::Index rung = 0; rung < rungs.values.size(); ++rung) {
    const bool any = std::any_of(plot.series.begin(), plot.series.end(), [&](const Series& series) {
      const auto* dots = std::get_if<Scatter>(&series.shape);
      return dots && std::isfinite(dots->y[rung]);
    });
    if (any) continue;
    const double x = rungs.values[rung];
    plot.series.push_back({"", Hue::text, Note{x, middle, "no numbers", Side::centre}});
    silent.push_back(rungs.names.empty() ? SignificantText(x)
                                         : rungs.names[static_cast<std::size_t>(rung)]);
  }
  return silent;
}

}  // namespace

std::optional<Figure> LadderFigure(const RunView& run) {
  const Rungs& rungs = run.rungs;
  if (rungs.values.size() < 2 || run.rows.empty()) return std::nullopt;

  Plot plot;
  std::vector<Eigen::VectorXd> shown;
  std::vector<Series> lines;
  // each identifier: quartiles as a band, medians as a line over the rungs
  for (std::size_t i = 0; i < run.rows.size(); ++i) {
    const RunRow& row = run.rows[i];
    const Hue hue = IdentifierHue(row.identifier);
    const QuartileCurve curve = RungsOf(row, rungs);
    plot.series.push_back({"", hue, Band{curve.x, curve.q25, curve.q75}});
    lines.push_back({row.label, hue, Line{curve.x, curve.median, 1.8, DashOf(run.rows, i)}});
    lines.push_back({"", hue, Scatter{curve.x, curve.median, 3, MarkerOf(run.rows, i)}});
    shown.insert(shown.end(), {curve.q25, curve.median, curve.q75});
  }
  // without any numbers there is nothing to show
  if (!std::isfinite(RangeOf(shown).first)) return std::nullopt;
  plot.series.insert(plot.series.end(), lines.begin(), lines.end());
  // root mean squares beside the bound, which is one itself
  const Scatter means = MeansOf(run);
  shown.push_back(means.y);
  const Eigen::VectorXd bound = BoundOf(run.rows.front(), rungs);
  if (bound.array().isFinite().any()) {
    plot.series.push_back(
        {"Cramér-Rao bound (rms)", Hue::text, Line{rungs.values, bound, 1.2, Dash::dashed}});
    shown.push_back(bound);
  }

  // rungs over more than a decade stand on a logarithmic axis
  const std::string unit = rungs.unit.empty() ? "" : fmt::format(" ({})", UnitText(rungs.unit));
  const bool wide =
      rungs.values.minCoeff() > 0 && rungs.values.maxCoeff() > 10 * rungs.values.minCoeff();
  plot.x = rungs.names.empty()
               ? (wide ? LogarithmicAxis(VariableName(rungs.variable) + unit, {rungs.values})
                       : LinearAxis(VariableName(rungs.variable) + unit, {rungs.values}))
               : CategoryAxis("", rungs.names);
  plot.y = MagnitudeAxis("NPE, continuous (%)", shown);

  // rungs without numbers are marked, and named in the finding
  const std::vector<std::string> silent = MarkSilent(rungs, plot);
  plot.series.push_back({"root mean square", Hue::text, means});
  const std::string title =
      rungs.names.empty() ? fmt::format("Parameter error against {}", VariableName(rungs.variable))
                          : "Parameter error in each variant";
  return SinglePlot(
      {"ladder", title, MediansSubtitle(run.suite, run.realizations), Finding(run, silent)}, plot);
}

}  // namespace warmjoint::report
