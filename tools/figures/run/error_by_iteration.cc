#include "tools/figures/run/error_by_iteration.h"

#include <fmt/core.h>

#include <cmath>

#include "tools/figures/axes.h"
#include "tools/figures/number_text.h"
#include "tools/figures/telling_apart.h"

namespace warmjoint::figures {
namespace {

using Curve = QuartileCurve IdentifierCourse::*;

bool Iterates(const QuartileCurve& curve) { return curve.x.size() > 1; }

/// The values at the places that the axis shows.
Eigen::VectorXd Shown(const Axis& axis, const Eigen::VectorXd& x, const Eigen::VectorXd& values) {
  return (x.array() >= axis.lower && x.array() <= axis.upper).select(values, std::nan(""));
}

/// The axis over the iterations of all identifiers.
Axis AxisOf(const ErrorByIteration& data) {
  std::vector<Eigen::VectorXd> iterations;
  for (const IdentifierCourse& course : data.identifiers) {
    if (Iterates(course.npe)) iterations.push_back(course.npe.x);
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
    const IdentifierCourse& course = data.identifiers[i];
    const QuartileCurve& c = course.*curve;
    if (c.x.size() == 0) continue;
    QuartileCurve wide = c;
    if (!Iterates(c)) {
      // over the whole axis
      wide.x = Eigen::Vector2d(plot.x.lower, plot.x.upper);
      wide.q25 = Eigen::Vector2d::Constant(c.q25[0]);
      wide.median = Eigen::Vector2d::Constant(c.median[0]);
      wide.q75 = Eigen::Vector2d::Constant(c.q75[0]);
    }
    const Hue hue = IdentifierHue(course.identifier);
    // quartiles as bands, medians as lines over all of them
    plot.series.push_back({"", hue, Band{wide.x, factor * wide.q25, factor * wide.q75}});
    lines.push_back(
        {course.label, hue, Line{wide.x, factor * wide.median, 1.8, DashOf(data.identifiers, i)}});
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
  for (const IdentifierCourse& course : data.identifiers) {
    if (course.npe.median.size() == 0) continue;
    const double last = course.npe.median[course.npe.median.size() - 1];
    text += fmt::format("{} {} %, ", course.label, SignificantText(100 * last));
  }
  // beside what no unbiased identifier can undercut
  if (data.cramer_rao) {
    return text + fmt::format("median at the Cramér-Rao bound {} %.",
                              SignificantText(100 * *data.cramer_rao));
  }
  text.resize(text.size() - 2);
  return text + ".";
}

}  // namespace

Figure MakeErrorByIteration(const ErrorByIteration& data) {
  Figure figure;
  figure.name = "error_by_iteration";
  figure.title = "Parameter error and fit by iteration";
  figure.subtitle = MediansSubtitle(data.suite, data.realizations);
  figure.finding = Finding(data);
  figure.height = 430;
  figure.columns = {1, 1};

  // errors of the parameters beside their bound
  Plot npe = Draw(data, &IdentifierCourse::npe, 100, "NPE, continuous (%)");
  if (data.cramer_rao) AddLevel(npe, "median at the Cramér-Rao bound", 100 * *data.cramer_rao);
  // errors of the fit beside the noise of the torque
  Plot rmse =
      Draw(data, &IdentifierCourse::rmse, 1, fmt::format("RMSE ({})", UnitText(data.torque_unit)));
  if (data.noise) AddLevel(rmse, "noise", *data.noise);

  figure.panels.push_back({"Normalised parameter error", npe, 0, 0});
  figure.panels.push_back({"Root mean square error of the fit", rmse, 0, 1});
  return figure;
}

}  // namespace warmjoint::figures
