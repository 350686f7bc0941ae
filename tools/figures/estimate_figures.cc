#include "tools/figures/estimate_figures.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>

#include "tools/figures/axes.h"
#include "tools/figures/envelope.h"
#include "tools/figures/figure.h"
#include "tools/figures/fit_page.h"
#include "tools/figures/fit_panels.h"
#include "tools/figures/fit_view.h"
#include "tools/figures/friction_map.h"
#include "tools/figures/log_figure.h"
#include "tools/figures/motor_angle.h"
#include "tools/figures/number_text.h"
#include "tools/figures/predicted.h"

namespace warmjoint::figures {
namespace {

constexpr int kSegments = 4;  // a loop, and a reversal on either side

Eigen::VectorXd Part(const Eigen::VectorXd& all, const Window& window) {
  return all.segment(window.begin, window.end - window.begin);
}

bool GoesBothWays(const FitView& view) {
  const Eigen::VectorXd kept = KeptOf(view, view.velocity);
  return kept.size() > 0 && kept.minCoeff() < 0 && kept.maxCoeff() > 0;
}

/// Torque over position within a window. limits: of the torque.
Plot Loop(const FitView& view, const Window& window, const std::pair<double, double>& limits) {
  const Eigen::VectorXd position = Part(view.position, window);
  Plot plot;
  plot.series = {{"measured", Hue::grey, Line{position, Part(view.torque, window), 1.4}}};
  // the fit has gaps where samples were left out
  if (view.has_fit) {
    const Eigen::VectorXd fitted = Part(KeptOrGap(view, view.fitted), window);
    plot.series.push_back(
        {FitLabel(view), Hue::vermilion, Line{position, fitted, 1.6, FitDash(view)}});
  }
  plot.x = LinearAxis(PositionLabel(view), {position});
  plot.y = {TorqueLabel(view, "torque"), limits.first, limits.second, Scale::linear, {}};
  return plot;
}

/// Torque over position in the first and in the last segments of the recording, with the fit: the height
/// of the loop is twice the friction, and what shrinks is its warming. Nothing where the joint moves in
/// one direction alone.
std::optional<Figure> MakeHysteresis(const FitView& view) {
  if (!GoesBothWays(view)) return std::nullopt;
  // the first and the last segments back and forth, over the same torques
  const Window first = ColdWindow(view, kSegments), last = WarmWindow(view, kSegments);
  const auto limits = TorqueLimits(view, first, last);
  Figure figure;
  figure.name = "hysteresis";
  figure.title = "Torque over position, back and forth";
  const std::string taken = TakenOff(view);
  figure.subtitle = OriginOf(view) + (taken.empty() ? "" : "; the torque is less " + taken);
  figure.finding =
      "The height of the loop is twice the friction; from the first to the last it changes by what "
      "the joint has warmed.";
  // both loops beside each other
  figure.height = 400;
  figure.columns = {1, 1};
  // a log without segments has its begin and its end
  const bool any = view.selection.segments.empty();
  figure.panels = {{any ? "The begin" : "First segments", Loop(view, first, limits), 0, 0},
                   {any ? "The end" : "Last segments", Loop(view, last, limits), 0, 1}};
  return figure;
}

std::string ValuesOf(const Estimate& estimate) {
  std::string text;
  for (const EstimatedParameter& parameter : estimate.parameters) {
    if (parameter.unit == "1") continue;  // the paper's discrete ones say nothing here
    text += fmt::format(" {} {} {},", parameter.name, SignificantText(parameter.value),
                        UnitText(parameter.unit));
  }
  if (!text.empty()) text.back() = '.';
  return text;
}

/// When the energy is largest, s.
double WarmestTime(const FitView& view) {
  Eigen::Index at = 0;
  view.energy.cwiseAbs().maxCoeff(&at);
  return view.time[at];
}

std::optional<Figure> FitPageOf(const EstimateView& view) {
  if (!view.fit) return std::nullopt;
  return MakeFitPage(*view.fit);
}

std::optional<Figure> CurveOf(const EstimateView& view) {
  if (!view.fit || !view.fit->has_fit || view.fit->selection.count() == 0) return std::nullopt;
  const Plot plot = FrictionCurve(*view.fit);
  // bands are spoken of only where some are drawn
  const bool has_band = std::any_of(plot.series.begin(), plot.series.end(), [](const auto& series) {
    return std::holds_alternative<Band>(series.shape);
  });
  return SinglePlot(
      {"friction_curve", "Friction over velocity",
       OriginOf(*view.fit) + (TakenOff(*view.fit).empty() ? "" : "; the torque is less ") +
           TakenOff(*view.fit) + (has_band ? "; bands are 95 % intervals of the curve" : ""),
       "Friction over velocity from these parameters:" + ValuesOf(view.estimate)},
      plot);
}

std::optional<Figure> WarmUpOf(const EstimateView& view) {
  if (!view.fit || !view.fit->warms() || view.fit->selection.count() == 0) return std::nullopt;
  const FitView& fit = *view.fit;
  const std::string finding = fmt::format(
      "Friction changes by E = {} {} at most, after {} {}.", SignificantText(WarmestEnergy(fit)),
      fit.torque_unit, SignificantText(WarmestTime(fit) / TimeUnit(fit)), TimeUnitName(fit));
  return SinglePlot({"warm_up", "Change of friction by its own heat", OriginOf(fit), finding},
                    WarmUpCurve(fit));
}

std::optional<Figure> TraceOf(const EstimateView& view) {
  return MakeTrace(view.estimate, view.fit ? view.fit->source : "");
}

std::optional<Figure> EnvelopeOf(const EstimateView& view) {
  // without a warming that was found, or constant speeds, a guess of one means nothing
  if (!view.fit || !view.fit->warms() || IsOfAnyMotion(*view.fit)) return std::nullopt;
  if (!view.estimate.friction->maps.empty() || view.estimate.gravity) return std::nullopt;
  return MakeEnvelope(view.fit->source, *view.measurements, view.fit->selection, std::nullopt);
}

std::optional<Figure> MotorAngleOf(const EstimateView& view) {
  return view.fit ? MakeMotorAngle(*view.fit) : std::nullopt;
}

std::optional<Figure> MotorMapOf(const EstimateView& view) {
  return view.fit ? MakeMotorMap(*view.fit) : std::nullopt;
}

std::optional<Figure> MotorFitOf(const EstimateView& view) {
  return view.fit ? MakeMotorFit(*view.fit) : std::nullopt;
}

std::optional<Figure> LogOf(const EstimateView& view) {
  return view.fit ? std::optional(MakeLogFigure(*view.fit)) : std::nullopt;
}

std::optional<Figure> PredictedOf(const EstimateView& view) {
  return view.fit ? MakePredicted(*view.fit) : std::nullopt;
}

std::optional<Figure> HeldOutOf(const EstimateView& view) {
  return view.held_out ? MakeHeldOut(*view.held_out) : std::nullopt;
}

std::optional<Figure> HysteresisOf(const EstimateView& view) {
  return view.fit ? MakeHysteresis(*view.fit) : std::nullopt;
}

std::optional<Figure> FrictionMapOf(const EstimateView& view) {
  return view.fit ? MakeFrictionMap(*view.fit) : std::nullopt;
}

}  // namespace

const std::vector<EstimateFigure>& EstimateFigures() {
  static const std::vector<EstimateFigure> figures{
      {"fit", "the story of one recording on one page", &FitPageOf, "its recording"},
      {"log", "the recording with its kept segments", &LogOf, "its recording"},
      {"predicted", "predicted torque over measured torque", &PredictedOf, "a fit"},
      {"held_out", "the same on samples that the fit has not seen", &HeldOutOf,
       "figures on held-out samples of its own recording"},
      {"friction_curve", "friction over velocity, cold and warm, with its band", &CurveOf, "a fit"},
      {"hysteresis", "torque over position, back and forth, at first and at last", &HysteresisOf,
       "segments in both directions"},
      {"warm_up", "E over time with its interval", &WarmUpOf, "a fit that warms"},
      {"trace", "parameters by iteration", &TraceOf, "an identifier that iterates"},
      {"envelope", "the recording's envelope and the first guess", &EnvelopeOf,
       "a fit that warms, at constant speeds, without maps or gravity"},
      {"motor_angle", "torque over motor angle", &MotorAngleOf,
       "a gear or the column motor_position"},
      {"motor_map", "the map over motor angle", &MotorMapOf, "a map over the motor's angle"},
      {"motor_fit", "torque in time with and without that map", &MotorFitOf,
       "a map over the motor's angle"},
      {"friction_map", "friction over angle and velocity, cold and warm", &FrictionMapOf,
       "a map over position or the motor's angle"},
  };
  return figures;
}

}  // namespace warmjoint::figures
