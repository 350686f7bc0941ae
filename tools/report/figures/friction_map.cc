#include "tools/report/figures/friction_map.h"

#include <fmt/core.h>

#include <cmath>
#include <limits>

#include "tools/report/draw/ticks.h"
#include "tools/report/figures/axes.h"

namespace warmjoint::report {
namespace {

constexpr Eigen::Index kColumns = 180, kRows = 120;

/// The angle that the maps are drawn over, with its axis.
struct Across {
  MapQuantity quantity;
  Axis axis;
};

std::optional<Across> AcrossOf(const FitView& view) {
  for (const FrictionMap& map : view.estimate.friction->maps) {
    if (FindAxis(map, MapQuantity::motor_position)) {
      return Across{MapQuantity::motor_position, AngleAxis("motor angle (rad)")};
    }
  }
  for (const FrictionMap& map : view.estimate.friction->maps) {
    if (!FindAxis(map, MapQuantity::position)) continue;
    const auto [lower, upper] = RangeOf({view.position});
    return Across{MapQuantity::position, {PositionLabel(view), lower, upper, Scale::linear, {}}};
  }
  return std::nullopt;
}

/// Slowest and fastest kept speed, rad/s or m/s.
std::pair<double, double> SpeedsOf(const FitView& view) {
  return RangeOf({KeptOf(view, view.velocity).cwiseAbs()});
}

/// sign(v) F with its rows at velocities from -fastest to fastest; NaN below the slowest speed.
HeatMap LevelMap(const FitView& view, const Across& across, double energy) {
  const auto [slowest, fastest] = SpeedsOf(view);
  HeatMap map{Eigen::MatrixXd(kRows, kColumns),
              {across.axis.lower, across.axis.upper},
              {-fastest, fastest},
              {0, 1},
              TorqueLabel(view, "sign(v) · friction")};
  const double middle = KeptOf(view, view.position).mean();
  const JointFriction sliding(*view.estimate.friction);
  for (Eigen::Index row = 0; row < kRows; ++row) {
    const double v = fastest * (2 * (static_cast<double>(row) + 0.5) / kRows - 1);
    for (Eigen::Index column = 0; column < kColumns; ++column) {
      const double share = (static_cast<double>(column) + 0.5) / kColumns;
      const double angle = across.axis.lower + share * (across.axis.upper - across.axis.lower);
      const bool over_motor = across.quantity == MapQuantity::motor_position;
      const JointPlace place{over_motor ? middle : angle, energy, 0, over_motor ? angle : 0};
      map.values(row, column) =
          std::abs(v) < slowest ? std::nan("") : Sign(v) * sliding.SlidingForce(v, place);
    }
  }
  return map;
}

Plot PanelOf(const FitView& view, const Across& across, HeatMap map,
             const std::pair<double, double>& colours) {
  map.colours = colours;
  Plot plot;
  plot.x = across.axis;
  plot.y = {SpeedLabel(view), map.y.first, map.y.second, Scale::linear, {}};
  plot.series.push_back({"", Hue::text, map});
  return plot;
}

}  // namespace

std::optional<Figure> MakeFrictionMap(const FitView& view) {
  if (!view.has_fit || view.selection.count() == 0) return std::nullopt;
  const std::optional<Across> across = AcrossOf(view);
  if (!across) return std::nullopt;

  std::vector<std::pair<std::string, HeatMap>> maps{{"Cold", LevelMap(view, *across, 0)}};
  if (view.warms()) {
    const double warmest = WarmestEnergy(view);
    maps.emplace_back(fmt::format("Warmest: E = {} {}", SignificantText(warmest), view.torque_unit),
                      LevelMap(view, *across, warmest));
  }
  std::vector<Eigen::VectorXd> all;
  for (const auto& [title, map] : maps) all.emplace_back(map.values.reshaped());
  const auto [lowest, highest] = RangeOf(all);
  const std::pair<double, double> colours{lowest, highest > lowest ? highest : lowest + 1};

  Figure figure;
  figure.name = "friction_map";
  figure.title = "Friction over angle and velocity";
  figure.subtitle = OriginOf(view) + "; empty where the joint never moved so slowly";
  const auto range = [](const HeatMap& map) { return RangeOf({map.values.reshaped()}); };
  figure.finding = "Friction";
  for (const auto& [title, map] : maps) {
    figure.finding += fmt::format(" {} {} to {} {},", &map == &maps[0].second ? "cold" : "warm",
                                  SignificantText(range(map).first),
                                  SignificantText(range(map).second), view.torque_unit);
  }
  figure.finding.back() = '.';
  figure.width = maps.size() > 1 ? 960 : 560;
  figure.height = 430;
  figure.columns.assign(maps.size(), 1);
  for (std::size_t i = 0; i < maps.size(); ++i) {
    figure.panels.push_back(
        {maps[i].first, PanelOf(view, *across, maps[i].second, colours), 0, static_cast<int>(i)});
  }
  return figure;
}

}  // namespace warmjoint::report
