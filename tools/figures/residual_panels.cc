// Panels of residuals: over what they may depend on, and over their own past.
#include <algorithm>
#include <cmath>

#include "identification/uncertainty/tails.h"
#include "models/foundation/robust_noise.h"
#include "tools/figures/axes.h"
#include "tools/figures/fit_panels.h"

namespace warmjoint::figures {
namespace {

constexpr int kBins = 40;
constexpr int kLags = 40;  // of the correlation

struct Abscissa {
  Eigen::VectorXd values;  // [n], kept samples
  std::string label;
};

Abscissa AbscissaOf(const FitView& view, SeenOver what) {
  switch (what) {
    case SeenOver::time:
      return {KeptOf(view, view.time) / TimeUnit(view), TimeLabel(view)};
    case SeenOver::position:
      return {KeptOf(view, view.position), PositionLabel(view)};
    case SeenOver::velocity:
      return {KeptOf(view, view.velocity), SpeedLabel(view)};
    case SeenOver::energy:
      return {KeptOf(view, view.energy), TorqueLabel(view, "E")};
    case SeenOver::motor_angle:
      return {KeptOf(view, view.motor_angle), "motor angle (rad)"};
  }
  return {};
}

/// Half of the range that holds all residuals.
double ReachOf(const Eigen::VectorXd& residuals) {
  const double reach = residuals.size() ? residuals.cwiseAbs().maxCoeff() : 0;
  return reach > 0 ? 1.05 * reach : 1;
}

/// Samples of the typical segment: how far back a memory is looked for.
Eigen::Index TypicalSegment(const FitView& view) {
  const std::size_t segments = view.selection.segments.size();
  const Eigen::Index n = view.time.size();
  if (segments == 0) return n / 4;
  return std::clamp<Eigen::Index>(view.selection.count() / static_cast<Eigen::Index>(segments), 20,
                                  n / 4);
}

/// 1, 2, 3, ... and then ever further apart, in samples; at most kLags.
std::vector<Eigen::Index> LagsTo(Eigen::Index longest) {
  std::vector<Eigen::Index> lags{1};
  const double growth = std::pow(std::max<double>(1, static_cast<double>(longest)), 1.0 / kLags);
  for (double lag = 1; lags.back() < longest; lag *= growth) {
    const auto next = static_cast<Eigen::Index>(std::lround(lag * growth));
    if (next > lags.back()) lags.push_back(std::min(next, longest));
  }
  return lags;
}

}  // namespace

Plot ResidualsOver(const FitView& view, SeenOver what) {
  const Abscissa across = AbscissaOf(view, what);
  const Eigen::VectorXd residuals = Residuals(view);
  Plot plot;
  plot.series.push_back({"", Hue::grey, Scatter{across.values, residuals, 0.9}});
  plot.series.push_back({"", Hue::text, LevelLine{0, Dash::dashed}});
  // medians off zero show what the model lacks
  const Line median = BinnedMedian(across.values, residuals, kBins);
  plot.series.push_back({"", Hue::vermilion, median});
  plot.series.push_back({"", Hue::vermilion, Scatter{median.x, median.y, 1.8}});
  plot.x = LinearAxis(across.label, {across.values});
  // as far up as down, with zero in the middle
  const double reach = ReachOf(residuals);
  plot.y = {TorqueLabel(view, "residual"), -reach, reach};
  return plot;
}

double ResidualCorrelation(const FitView& view, Eigen::Index lag) {
  const Eigen::VectorXd residuals = Residuals(view);
  // mean and variance of the kept residuals
  const double mean = residuals.mean();
  const double variance = (residuals.array() - mean).square().mean();
  const Eigen::VectorXd centred = (view.torque - view.fitted).array() - mean;
  double sum = 0;
  Eigen::Index pairs = 0;
  // pairs of kept samples that lie this lag apart
  for (Eigen::Index i = 0; i + lag < centred.size(); ++i) {
    if (!view.selection.keep[i] || !view.selection.keep[i + lag]) continue;
    sum += centred[i] * centred[i + lag];
    ++pairs;
  }
  return pairs > 0 && variance > 0 ? sum / (static_cast<double>(pairs) * variance) : 0;
}

Plot ResidualMemory(const FitView& view) {
  const Eigen::Index n = view.time.size();
  const double step = MedianStep(view.time);  // s
  // lags reach as far as a typical segment
  const std::vector<Eigen::Index> lags = LagsTo(std::min(TypicalSegment(view), n / 4));
  Eigen::VectorXd lag(static_cast<Eigen::Index>(lags.size())), correlation(lag.size());
  for (Eigen::Index k = 0; k < lag.size(); ++k) {
    lag[k] = static_cast<double>(lags[static_cast<std::size_t>(k)]) * step;
    correlation[k] = ResidualCorrelation(view, lags[static_cast<std::size_t>(k)]);
  }
  // 95 % of the correlations of white residuals stay within
  const double bound = kNormal95 / std::sqrt(static_cast<double>(view.selection.count()));

  Plot plot;
  plot.series.push_back({"", Hue::blue, Line{lag, correlation, 1.2}});
  plot.series.push_back({"", Hue::blue, Scatter{lag, correlation, 2.5}});
  for (double level : {bound, -bound}) plot.series.push_back({"", Hue::text, LevelLine{level}});
  plot.x = LogarithmicAxis("lag (s), from one sample on", {lag});
  plot.y = LinearAxis("correlation", {correlation, Eigen::Vector3d(0, 2 * bound, -2 * bound)});
  return plot;
}

}  // namespace warmjoint::figures
