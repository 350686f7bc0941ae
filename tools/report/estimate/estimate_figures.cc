#include "tools/report/estimate/estimate_figures.h"

#include <fmt/core.h>

#include "tools/report/draw/ticks.h"
#include "tools/report/figures/envelope.h"
#include "tools/report/figures/fit_page.h"
#include "tools/report/figures/fit_panels.h"
#include "tools/report/figures/friction_map.h"
#include "tools/report/figures/motor_angle.h"

namespace warmjoint::report {
namespace {

/// A figure of one plot.
Figure Single(const std::string& name, const std::string& title, const FitView& view,
              const Plot& plot) {
  Figure figure;
  figure.name = name;
  figure.title = title;
  figure.subtitle = fmt::format("{}, identified by {}", view.source, view.estimate.identifier);
  figure.width = 720;
  figure.height = 440;
  figure.panels.push_back({"", plot});
  return figure;
}

std::string IntervalsOf(const Estimate& estimate) {
  std::string text;
  for (const EstimatedParameter& parameter : estimate.parameters) {
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
  Figure figure =
      Single("friction_curve", "Friction over velocity", *view.fit, FrictionCurve(*view.fit));
  figure.subtitle += "; bands are 95 % intervals of the curve";
  figure.finding = "Friction over velocity from these parameters:" + IntervalsOf(view.estimate);
  return figure;
}

std::optional<Figure> WarmUpOf(const EstimateView& view) {
  if (!view.fit || !view.fit->warms() || view.fit->selection.count() == 0) return std::nullopt;
  const FitView& fit = *view.fit;
  Figure figure = Single("warm_up", "Change of friction by its own heat", fit, WarmUpCurve(fit));
  figure.finding = fmt::format(
      "Friction changes by E = {} {} at most, after {} {}.", SignificantText(WarmestEnergy(fit)),
      fit.torque_unit, SignificantText(WarmestTime(fit) / TimeUnit(fit)), TimeUnitName(fit));
  return figure;
}

std::optional<Figure> TraceOf(const EstimateView& view) {
  return MakeTrace(view.estimate, view.fit ? view.fit->source : "");
}

std::optional<Figure> EnvelopeOf(const EstimateView& view) {
  if (!view.fit) return std::nullopt;
  return MakeEnvelope(view.fit->source, *view.measurements, view.fit->selection, std::nullopt);
}

std::optional<Figure> MotorAngleOf(const EstimateView& view) {
  return view.fit ? MakeMotorAngle(*view.fit) : std::nullopt;
}

std::optional<Figure> MotorMapOf(const EstimateView& view) {
  return view.fit ? MakeMotorMapFit(*view.fit) : std::nullopt;
}

std::optional<Figure> FrictionMapOf(const EstimateView& view) {
  return view.fit ? MakeFrictionMap(*view.fit) : std::nullopt;
}

}  // namespace

EstimateView MakeEstimateView(Estimate estimate, std::optional<Measurements> measurements) {
  EstimateView view{std::move(estimate), std::move(measurements), std::nullopt};
  if (view.measurements) {
    view.fit =
        MakeFitView(*view.measurements, SelectConstantSpeed(*view.measurements), view.estimate);
  }
  return view;
}

const std::vector<EstimateFigure>& EstimateFigures() {
  static const std::vector<EstimateFigure> figures{
      {"fit", "the story of one recording on one page", &FitPageOf},
      {"friction_curve", "friction over velocity, cold and warm, with its band", &CurveOf},
      {"warm_up", "E over time with its interval", &WarmUpOf},
      {"trace", "parameters by iteration", &TraceOf},
      {"envelope", "the recording's envelope and the first guess", &EnvelopeOf},
      {"motor_angle", "torque over motor angle", &MotorAngleOf},
      {"motor_map", "the fit with kernels over motor angle", &MotorMapOf},
      {"friction_map", "friction over angle and velocity, cold and warm", &FrictionMapOf},
  };
  return figures;
}

}  // namespace warmjoint::report
