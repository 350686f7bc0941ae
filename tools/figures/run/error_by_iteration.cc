#include "tools/figures/run/error_by_iteration.h"

#include <fmt/core.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "models/foundation/random_stream.h"
#include "tools/figures/axes.h"
#include "tools/figures/run/run_figures.h"
#include "tools/figures/symbols.h"

namespace warmjoint::figures {
namespace {

using Curve = QuartileCurve IdentifierCurves::*;

bool Iterates(const QuartileCurve& curve) { return curve.x.size() > 1; }

/// The values at the places that the axis shows.
Eigen::VectorXd Shown(const Axis& axis, const Eigen::VectorXd& x, const Eigen::VectorXd& values) {
  return (x.array() >= axis.lower && x.array() <= axis.upper).select(values, std::nan(""));
}

/// The axis over the iterations of all identifiers.
Axis AxisOf(const ErrorByIteration& data) {
  std::vector<Eigen::VectorXd> iterations;
  for (const IdentifierCurves& curves : data.identifiers) {
    if (Iterates(curves.npe)) iterations.push_back(curves.npe.x);
  }
  const auto [first, last] = RangeOf(iterations);
  if (!std::isfinite(last)) return {"iteration", 0, 1, Scale::linear, {{0, "–"}}};
  return IterationAxis(first, last);
}

/// Bands below all lines; identifiers that do not iterate as levels.
Plot Draw(const ErrorByIteration& data, Curve curve, double factor, const std::string& label) {
  Plot plot;
  plot.x = AxisOf(data);
  std::vector<Eigen::VectorXd> shown;
  std::vector<Series> lines;
  for (std::size_t i = 0; i < data.identifiers.size(); ++i) {
    const IdentifierCurves& curves = data.identifiers[i];
    const QuartileCurve& c = curves.*curve;
    if (c.x.size() == 0) continue;
    QuartileCurve wide = c;
    if (!Iterates(c)) {
      // over the whole axis
      wide.x = Eigen::Vector2d(plot.x.lower, plot.x.upper);
      wide.q25 = Eigen::Vector2d::Constant(c.q25[0]);
      wide.median = Eigen::Vector2d::Constant(c.median[0]);
      wide.q75 = Eigen::Vector2d::Constant(c.q75[0]);
    }
    const Hue hue = IdentifierHue(curves.identifier);
    // quartiles as bands, medians as lines over all of them
    plot.series.push_back({"", hue, Band{wide.x, factor * wide.q25, factor * wide.q75}});
    lines.push_back(
        {curves.label, hue, Line{wide.x, factor * wide.median, 1.8, DashOf(data.identifiers, i)}});
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

std::string Finding(const ErrorByIteration& data) {
  std::string text = "Median NPE after the last iteration: ";
  // where each identifier ends
  for (const IdentifierCurves& curves : data.identifiers) {
    if (curves.npe.median.size() == 0) continue;
    const double last = curves.npe.median[curves.npe.median.size() - 1];
    text += fmt::format("{} {} %, ", curves.label, SignificantText(100 * last));
  }
  // beside what no unbiased identifier can undercut
  if (data.cramer_rao) {
    return text + fmt::format("median at the Cramér-Rao bound {} %.",
                              SignificantText(100 * *data.cramer_rao));
  }
  text.resize(text.size() - 2);
  return text + ".";
}

/// "table1: 50 realizations; lines are medians, bands reach from quartile to quartile".
std::string Subtitle(const ErrorByIteration& data) {
  return fmt::format(
      "{}: {} realization{}; lines are medians, bands reach from quartile to quartile", data.suite,
      data.realizations, data.realizations == 1 ? "" : "s");
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

/// The final values as curves of one iteration, 0.
QuartileCurve Level(const Eigen::VectorXd& values) {
  return QuartilesOf(Eigen::VectorXd::Zero(1), values);
}

IdentifierCurves CurvesOf(const RunRow& row) {
  IdentifierCurves curves{row.label, row.identifier, {}, {}};
  if (row.trace.iteration.size() > 0) {
    curves.npe = QuartilesOf(row.trace.iteration, row.trace.npe);
    curves.rmse = QuartilesOf(row.trace.iteration, row.trace.rmse);
  } else if (row.npe.array().isFinite().any()) {
    curves.npe = Level(row.npe);
    curves.rmse = Level(row.rmse);
  }
  return curves;
}

}  // namespace

Figure MakeErrorByIteration(const ErrorByIteration& data) {
  // errors of the parameters beside their bound
  Plot npe = Draw(data, &IdentifierCurves::npe, 100, "NPE, continuous (%)");
  if (data.cramer_rao) AddLevel(npe, "median at the Cramér-Rao bound", 100 * *data.cramer_rao);
  // errors of the fit beside the noise of the torque
  Plot rmse =
      Draw(data, &IdentifierCurves::rmse, 1, fmt::format("RMSE ({})", UnitText(data.torque_unit)));
  if (data.noise) AddLevel(rmse, "noise", *data.noise);

  return RowOfPlots(
      {"error_by_iteration", "Parameter error and fit by iteration", Subtitle(data), Finding(data)},
      430, {{"Normalised parameter error", npe}, {"Root mean square error of the fit", rmse}});
}

std::optional<Figure> ErrorTraces(const RunView& run) {
  ErrorByIteration data;
  data.suite = run.suite;
  data.realizations = run.realizations;
  data.torque_unit = run.torque_unit;
  bool any = false;
  // traces of all identifiers, of which one at least has to iterate
  for (const RunRow& row : run.rows) {
    data.identifiers.push_back(CurvesOf(row));
    any = any || row.trace.iteration.size() > 1;
  }
  if (!any) return std::nullopt;
  // a median to compare medians with; variants have a bound each
  if (run.bound_covariance.size() > 0 && run.rungs.values.size() < 2) {
    data.cramer_rao = MedianNormOf(run.bound_covariance) / 100;
  }
  if (std::isfinite(run.noise) && run.noise > 0) data.noise = run.noise;
  return MakeErrorByIteration(data);
}

}  // namespace warmjoint::figures
