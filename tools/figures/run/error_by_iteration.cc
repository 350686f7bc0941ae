// NPE and RMSE by iteration, as in the paper's Fig. 6.
#include <fmt/core.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "models/foundation/random_stream.h"
#include "tools/board/statistics.h"
#include "tools/figures/axes.h"
#include "tools/figures/run/run_figures.h"
#include "tools/figures/symbols.h"

namespace warmjoint::figures {
namespace {

using Traces = Eigen::MatrixXd ParameterTrace::*;
using Finals = Eigen::VectorXd RunRow::*;

bool Iterates(const RunRow& row) { return row.trace.iteration.size() > 1; }

/// An error of a row by iteration, of one without a trace the final values at a single iteration, 0; empty without an answer.
QuartileCurve CurveOf(const RunRow& row, Traces traces, Finals finals) {
  if (row.trace.iteration.size() > 0) return QuartilesOf(row.trace.iteration, row.trace.*traces);
  if (!row.npe.array().isFinite().any()) return {};
  return QuartilesOf(Eigen::VectorXd::Zero(1), row.*finals);
}

/// The values at the places that the axis shows.
Eigen::VectorXd Shown(const Axis& axis, const Eigen::VectorXd& x, const Eigen::VectorXd& values) {
  return (x.array() >= axis.lower && x.array() <= axis.upper).select(values, std::nan(""));
}

/// The axis over the iterations of all identifiers.
Axis AxisOf(const RunView& run) {
  std::vector<Eigen::VectorXd> iterations;
  for (const RunRow& row : run.rows) {
    if (Iterates(row)) iterations.push_back(row.trace.iteration);
  }
  const auto [first, last] = RangeOf(iterations);
  if (!std::isfinite(last)) return {"iteration", 0, 1, Scale::linear, {{0, "–"}}};
  return IterationAxis(first, last);
}

/// Bands below all lines; identifiers that do not iterate as levels.
Plot Draw(const RunView& run, Traces traces, Finals finals, double factor,
          const std::string& label) {
  Plot plot;
  plot.x = AxisOf(run);
  std::vector<Eigen::VectorXd> shown;
  std::vector<Series> lines;
  for (std::size_t i = 0; i < run.rows.size(); ++i) {
    const RunRow& row = run.rows[i];
    QuartileCurve wide = CurveOf(row, traces, finals);
    if (wide.x.size() == 0) continue;
    if (!Iterates(row)) {
      // over the whole axis
      wide.x = Eigen::Vector2d(plot.x.lower, plot.x.upper);
      for (Eigen::VectorXd* level : {&wide.q25, &wide.median, &wide.q75}) {
        const double value = (*level)[0];
        *level = Eigen::Vector2d::Constant(value);
      }
    }
    const Hue hue = IdentifierHue(row.identifier);
    // quartiles as bands, medians as lines over all of them
    plot.series.push_back({"", hue, Band{wide.x, factor * wide.q25, factor * wide.q75}});
    lines.push_back({row.label, hue, Line{wide.x, factor * wide.median, 1.8, DashOf(run.rows, i)}});
    // the axis has to reach every quartile
    for (const Eigen::VectorXd& values : {wide.q25, wide.median, wide.q75}) {
      shown.push_back(Shown(plot.x, wide.x, factor * values));
    }
  }
  plot.series.insert(plot.series.end(), lines.begin(), lines.end());
  plot.y = MagnitudeAxis(label, shown);
  return plot;
}

/// Adds a dashed level and makes room for it.
void AddLevel(Plot& plot, const std::string& label, double value) {
  plot.series.push_back({label, Hue::text, LevelLine{value}});
  const double room = plot.y.scale == Scale::logarithmic ? 1.25 : 1.05;
  plot.y.upper = std::max(plot.y.upper, room * value);
  if (plot.y.scale == Scale::logarithmic) plot.y.lower = std::min(plot.y.lower, value / room);
}

/// cramer_rao: median NPE at the bound, 0.012 is 1.2 %; nothing where it is not known.
std::string Finding(const RunView& run, std::optional<double> cramer_rao) {
  std::string text = "Median NPE after the last iteration: ";
  // where each identifier ends
  for (const RunRow& row : run.rows) {
    const Eigen::MatrixXd& traces = row.trace.npe;
    const double last = MedianOfKnown(traces.cols() > 0 ? traces.rightCols<1>() : row.npe);
    if (std::isnan(last)) continue;
    text += fmt::format("{} {} %, ", row.label, SignificantText(100 * last));
  }
  // beside what no unbiased identifier can undercut
  if (cramer_rao) {
    return text +
           fmt::format("median at the Cramér-Rao bound {} %.", SignificantText(100 * *cramer_rao));
  }
  text.resize(text.size() - 2);
  return text + ".";
}

/// "table1: 50 realizations; lines are medians, bands reach from quartile to quartile".
std::string Subtitle(const RunView& run) {
  return fmt::format(
      "{}: {} realization{}; lines are medians, bands reach from quartile to quartile", run.suite,
      run.realizations, run.realizations == 1 ? "" : "s");
}

/// Median of |x| of a normal x with covariance C [d x d], by 20001 draws that are always the same: known
/// to 1 %. Where C is the bound of relative errors, the median NPE of an estimator that stands at it.
double MedianNormOf(const Eigen::MatrixXd& covariance) {
  constexpr std::size_t kDraws = 20001;
  // errors at the bound are normal with this covariance
  const Eigen::MatrixXd root = covariance.llt().matrixL();
  RandomStream random({1, 0}, Stream::truth);
  std::vector<double> norms(kDraws);
  Eigen::VectorXd draw(covariance.rows());
  // the median of their norms has no formula and is drawn
  for (double& norm : norms) {
    for (double& value : draw) value = random.Normal();
    norm = (root * draw).norm();
  }
  std::nth_element(norms.begin(), norms.begin() + kDraws / 2, norms.end());
  return norms[kDraws / 2];
}

}  // namespace

std::optional<Figure> ErrorTraces(const RunView& run) {
  // of all identifiers, one at least has to iterate
  if (std::ranges::none_of(run.rows, &Iterates)) return std::nullopt;
  // a median to compare medians with; variants have a bound each
  std::optional<double> cramer_rao;
  if (run.bound_covariance.size() > 0 && run.rungs.values.size() < 2) {
    cramer_rao = MedianNormOf(run.bound_covariance) / 100;
  }

  // errors of the parameters beside their bound
  Plot npe = Draw(run, &ParameterTrace::npe, &RunRow::npe, 100, "NPE, continuous (%)");
  if (cramer_rao) AddLevel(npe, "median at the Cramér-Rao bound", 100 * *cramer_rao);
  // errors of the fit beside the noise of the torque
  Plot rmse =
      Draw(run, &ParameterTrace::rmse, &RunRow::rmse, 1, fmt::format("RMSE ({})", run.torque_unit));
  if (std::isfinite(run.noise) && run.noise > 0) AddLevel(rmse, "noise", run.noise);

  return RowOfPlots(
      {"error_by_iteration", "Parameter error and fit by iteration", Subtitle(run),
       Finding(run, cramer_rao)},
      430, {{"Normalised parameter error", npe}, {"Root mean square error of the fit", rmse}});
}

}  // namespace warmjoint::figures
