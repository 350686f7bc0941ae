#include "tools/figures/estimate_figures.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>

#include "tools/figures/axes.h"
#include "tools/figures/figure.h"
#include "tools/figures/fit_panels.h"
#include "tools/figures/fit_view.h"
#include "tools/figures/symbols.h"

namespace warmjoint::figures {
namespace {

constexpr int kSegments = 4;  // a loop, and a reversal on either side

bool GoesInBothDirections(const FitView& view) {
  const Eigen::VectorXd kept = KeptOf(view, view.velocity);
  return kept.size() > 0 && kept.minCoeff() < 0 && kept.maxCoeff() > 0;
}

/// Torque over position within a window.
Plot Loop(const FitView& view, const Window& window, const Axis& torque) {
  const Eigen::VectorXd position = window.Of(view.position);
  Plot plot;
  plot.series = {{"measured", Hue::grey, Line{position, window.Of(view.torque), 1.4}}};
  // the fit has gaps where samples were left out
  if (view.has_fit) {
    const Eigen::VectorXd fitted = window.Of(KeptOrGap(view, view.fitted));
    plot.series.push_back(
        {FitLabel(view), Hue::vermilion, Line{position, fitted, 1.6, FitDash(view)}});
  }
  plot.x = LinearAxis(PositionLabel(view), {position});
  plot.y = torque;
  return plot;
}

/// Torque over position in the first and in the last segments of the recording, with the fit: the height
/// of the loop is twice the friction, and what shrinks is its warming. Nothing where the joint moves in
/// one direction alone.
std::optional<Figure> MakeHysteresis(const FitView& view) {
  if (!GoesInBothDirections(view)) return std::nullopt;
  // the first and the last segments back and forth, over the same torques
  const Window first = ColdWindow(view, kSegments), last = WarmWindow(view, kSegments);
  const Axis torque = TorqueAxis(view, first, last);
  const std::string taken = TakenOff(view);
  // a log without segments has its begin and its end
  const bool any = view.selection.segments.empty();
  return RowOfPlots(
      {"hysteresis", "Torque over position, back and forth",
       OriginOf(view) + (taken.empty() ? "" : "; the torque is less " + taken),
       "The height of the loop is twice the friction; from the first to the last it changes by "
       "what the joint has warmed."},
      400,
      {{any ? "The begin" : "First segments", Loop(view, first, torque)},
       {any ? "The end" : "Last segments", Loop(view, last, torque)}});
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

std::optional<Figure> MakeCurve(const FitView& view) {
  if (!view.has_fit || view.selection.count() == 0) return std::nullopt;
  const Plot plot = FrictionCurve(view);
  // bands are spoken of only where some are drawn
  const bool has_band = std::any_of(plot.series.begin(), plot.series.end(), [](const auto& series) {
    return std::holds_alternative<Band>(series.shape);
  });
  const std::string taken = TakenOff(view);
  return SinglePlot({"friction_curve", "Friction over velocity",
                     OriginOf(view) + (taken.empty() ? "" : "; the torque is less " + taken) +
                         (has_band ? "; bands are 95 % intervals of the curve" : ""),
                     "Friction over velocity from these parameters:" + ValuesOf(view.estimate)},
                    plot);
}

std::optional<Figure> MakeWarmUp(const FitView& view) {
  if (!view.warms() || view.selection.count() == 0) return std::nullopt;
  const double at = view.time[WarmestSample(view)] / TimeUnit(view);
  const std::string finding = fmt::format("Friction changes by E = {} {} at most, after {} {}.",
                                          SignificantText(WarmestEnergy(view)), view.torque_unit,
                                          SignificantText(at), TimeUnitName(view));
  return SinglePlot({"warm_up", "Change of friction by its own heat", OriginOf(view), finding},
                    WarmUpCurve(view));
}

/// The picture of an estimate that is one of its fit; nothing without its recording.
template <auto Make>
std::optional<Figure> OfFit(const EstimateView& view) {
  if (!view.fit) return std::nullopt;
  return Make(*view.fit);
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

std::optional<Figure> HeldOutOf(const EstimateView& view) {
  return view.held_out ? MakeHeldOut(*view.held_out) : std::nullopt;
}

/// One column of the recording; the kept samples lie on top.
Plot ColumnPlot(const FitView& view, const Eigen::VectorXd& values, const std::string& label) {
  const Eigen::VectorXd time = view.time / TimeUnit(view);
  Plot plot;
  plot.series = {{"all samples", Hue::grey, Line{time, values, 1.0}},
                 {"kept for the fit", Hue::blue, Line{time, KeptOrGap(view, values), 1.4}}};
  plot.x = TimeAxis(view);
  plot.y = LinearAxis(label, {values});
  return plot;
}

}  // namespace

const std::vector<EstimateFigure>& EstimateFigures() {
  static const std::vector<EstimateFigure> figures{
      {"fit", "the story of one recording on one page", &OfFit<MakeFitPage>, "its recording"},
      {"log", "the recording with its kept segments", &OfFit<MakeLogFigure>, "its recording"},
      {"predicted", "predicted torque over measured torque", &OfFit<MakePredicted>, "a fit"},
      {"held_out", "the same on samples that the fit has not seen", &HeldOutOf,
       "figures on held-out samples of its own recording"},
      {"friction_curve", "friction over velocity, cold and warm, with its band", &OfFit<MakeCurve>,
       "a fit"},
      {"hysteresis", "torque over position, back and forth, at first and at last",
       &OfFit<MakeHysteresis>, "segments in both directions"},
      {"warm_up", "E over time with its interval", &OfFit<MakeWarmUp>, "a fit that warms"},
      {"trace", "parameters by iteration", &TraceOf, "an identifier that iterates"},
      {"envelope", "the recording's envelope and the first guess", &EnvelopeOf,
       "a fit that warms, at constant speeds, without maps or gravity"},
      {"motor_angle", "torque over motor angle", &OfFit<MakeMotorAngle>,
       "a gear or the column motor_position"},
      {"motor_map", "the map over motor angle", &OfFit<MakeMotorMap>,
       "a map over the motor's angle"},
      {"motor_fit", "torque in time with and without that map", &OfFit<MakeMotorFit>,
       "a map over the motor's angle"},
      {"friction_map", "friction over angle and velocity, cold and warm", &OfFit<MakeFrictionMap>,
       "a map over position or the motor's angle"},
  };
  return figures;
}

Figure MakeLogFigure(const FitView& view) {
  // how much of the log is kept, and from what motion
  const auto samples = view.time.size();
  const auto kept = view.selection.count();
  const double share = 100 * static_cast<double>(kept) / static_cast<double>(samples);
  const std::string segments = IsOfAnyMotion(view) ? "from motion of any kind"
                                                   : fmt::format("in {} segments of constant speed",
                                                                 view.selection.segments.size());
  // the same in words, below the title and for readers who cannot see it
  Figure figure = WithoutPanels(
      {"log", view.source,
       fmt::format("{} samples; {:.0f} % of them are kept, {}", samples, share, segments),
       fmt::format("Of {} samples {:.0f} % are kept for the fit, {}.", samples, share, segments)});
  // the torque as it was logged, with inertia and gravity
  const Eigen::VectorXd torque = view.torque + view.rigid;
  const Eigen::VectorXd* columns[] = {&view.position, &view.velocity, &torque};
  const std::string labels[] = {PositionLabel(view), SpeedLabel(view), TorqueLabel(view, "torque")};
  for (int i = 0; i < 3; ++i) {
    Plot plot = ColumnPlot(view, *columns[i], labels[i]);
    // one legend and one name of the time for all
    if (i > 0) plot.series[0].label = plot.series[1].label = "";
    if (i < 2) plot.x.label = "";
    AddPanel(figure, "", plot, 170);
  }
  return figure;
}

}  // namespace warmjoint::figures
