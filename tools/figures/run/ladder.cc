// Parameter error against the variable that a suite's ladder climbs.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "tools/board/statistics.h"
#include "tools/figures/axes.h"
#include "tools/figures/run/run_figures.h"
#include "tools/figures/symbols.h"

namespace warmjoint::figures {
namespace {

/// The rms of the row's NPE at each rung, per cent; NaN where it has none.
Eigen::VectorXd ErrorsOf(const RunRow& row, const Rungs& rungs) {
  Eigen::VectorXd errors(rungs.values.size());
  for (Eigen::Index rung = 0; rung < errors.size(); ++rung) {
    const Eigen::VectorXd npe = At(row, row.npe, rung);
    errors[rung] = 100 * RootMeanSquareOf({npe.begin(), npe.end()});
  }
  return errors;
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

/// " energy-ml 0.107 to 10.7 %," along the ladder; " energy-ml 0.84 % (ladder) to 8.7 % (slow),"
/// where variants have names alone.
std::string RangeText(const std::string& label, const Eigen::VectorXd& errors,
                      const std::vector<std::string>& names) {
  // rungs in order have a first and a last
  if (names.empty()) {
    return fmt::format(" {} {} to {} %,", label, SignificantText(errors[0]),
                       SignificantText(errors.tail(1)[0]));
  }
  // variants have a best and a worst
  if (!errors.array().isFinite().any()) return fmt::format(" {} none,", label);
  Eigen::Index best = 0, worst = 0;
  errors.minCoeff<Eigen::PropagateNumbers>(&best);
  errors.maxCoeff<Eigen::PropagateNumbers>(&worst);
  return fmt::format(" {} {} % ({}) to {} % ({}),", label, SignificantText(errors[best]),
                     names[static_cast<std::size_t>(best)], SignificantText(errors[worst]),
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
                         ? fmt::format("Rms NPE from the first rung of {} to the last:",
                                       VariableName(rungs.variable))
                         : "Rms NPE in the best and the worst variant:";
  for (const RunRow& row : run.rows) {
    text += RangeText(row.label, ErrorsOf(row, rungs), rungs.names);
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
  // each identifier over the rungs: root mean squares, as the bound is one
  for (std::size_t i = 0; i < run.rows.size(); ++i) {
    const RunRow& row = run.rows[i];
    const Hue hue = IdentifierHue(row.identifier);
    const Eigen::VectorXd errors = ErrorsOf(row, rungs);
    plot.series.push_back({row.label, hue, Line{rungs.values, errors, 1.8, DashOf(run.rows, i)}});
    plot.series.push_back({"", hue, Scatter{rungs.values, errors, 3, MarkerOf(run.rows, i)}});
    shown.push_back(errors);
  }
  // without any numbers there is nothing to show
  if (!std::isfinite(RangeOf(shown).first)) return std::nullopt;
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
  plot.y = MagnitudeAxis("rms NPE, continuous (%)", shown);

  // rungs without numbers are marked, and named in the finding
  const std::vector<std::string> silent = MarkSilent(rungs, plot);
  const std::string title =
      rungs.names.empty() ? fmt::format("Parameter error against {}", VariableName(rungs.variable))
                          : "Parameter error in each variant";
  return SinglePlot({"ladder", title,
                     fmt::format("{}: root mean squares of {} realizations at each", run.suite,
                                 run.realizations / static_cast<int>(rungs.values.size())),
                     Finding(run, silent)},
                    plot);
}

}  // namespace warmjoint::figures
