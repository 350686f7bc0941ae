// Several estimates in one picture.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>

#include "tools/figures/axes.h"
#include "tools/figures/estimate_figures.h"
#include "tools/figures/fit_panels.h"

namespace warmjoint::figures {
namespace {

constexpr Hue kHues[] = {Hue::blue, Hue::vermilion, Hue::green, Hue::purple, Hue::orange, Hue::sky};
constexpr Dash kDashes[] = {Dash::solid, Dash::dashed, Dash::dotted};

using Fits = std::vector<std::pair<std::string, const FitView*>>;

Fits FitsOf(const std::vector<NamedEstimate>& estimates) {
  Fits fits;
  for (const auto& [name, view] : estimates) {
    if (view.fit && view.fit->has_fit && view.fit->selection.count() > 0) {
      fits.emplace_back(name, &*view.fit);
    }
  }
  return fits;
}

/// The look of the estimate at a place: a colour each, then other strokes.
Hue HueAt(std::size_t place) { return kHues[place % std::size(kHues)]; }
Dash DashAt(std::size_t place) { return kDashes[place / std::size(kHues) % std::size(kDashes)]; }

/// The cold curves of all over the samples of the first; each curve without warming is cold all along.
Plot Curves(const Fits& fits) {
  Plot plot = FrictionCurve(*fits.front().second);
  // of the first plot only its measured samples stay
  std::erase_if(plot.series, [](const Series& one) {
    return !std::holds_alternative<Scatter>(one.shape) || one.label.empty();
  });
  // each estimate adds its cold curve
  for (std::size_t i = 0; i < fits.size(); ++i) {
    std::string label = fits[i].first;
    for (const Series& own : FrictionCurve(*fits[i].second).series) {
      const auto* line = std::get_if<Line>(&own.shape);
      if (!line || own.hue != Hue::blue) continue;
      plot.series.push_back({label, HueAt(i), Line{line->x, line->y, 2.0, DashAt(i)}});
      label.clear();
    }
  }
  return plot;
}

/// E over time of those that warm.
Plot WarmUps(const Fits& fits) {
  Plot plot;
  std::vector<Eigen::VectorXd> times, energies;
  const FitView& first = *fits.front().second;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const FitView& fit = *fits[i].second;
    // an estimate without warming has no energy
    if (!fit.warms()) continue;
    times.push_back(fit.time / TimeUnit(first));
    energies.push_back(fit.energy);
    plot.series.push_back(
        {fits[i].first, HueAt(i), Line{times.back(), energies.back(), 2.0, DashAt(i)}});
  }
  plot.x = LinearAxis(TimeLabel(first), times);
  plot.y = LinearAxis(TorqueLabel(first, "E"), energies);
  return plot;
}

}  // namespace

std::optional<Figure> MakeOverlay(const std::vector<NamedEstimate>& estimates) {
  const Fits fits = FitsOf(estimates);
  if (fits.size() < 2) return std::nullopt;
  // who is compared, and on whose samples
  std::vector<std::string> names;
  for (const auto& [name, fit] : fits) names.push_back(name);
  // friction over velocity, all while cold, and beside it their warm-ups, where some warm
  return RowOfPlots({"estimates", "Friction by several estimates",
                     fmt::format("samples are of {}", fits.front().second->source),
                     fmt::format("Cold friction over velocity by {}.", fmt::join(names, ", "))},
                    430,
                    {{"Friction over velocity, cold", Curves(fits)}, {"Warm-up", WarmUps(fits)}});
}

}  // namespace warmjoint::figures
