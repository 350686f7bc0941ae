// Friction over angle and speed as a heat map.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tools/figures/axes.h"
#include "tools/figures/estimate_figures.h"
#include "tools/figures/symbols.h"

namespace warmjoint::figures {
namespace {

constexpr Eigen::Index kColumns = 180, kRows = 120;

/// The angle that the maps are drawn over, with its axis.
struct Across {
  bool motor;  // its angle, or the joint's position
  Axis axis;

  const Eigen::VectorXd& Of(const FitView& view) const {
    return motor ? view.motor_angle : view.position;
  }
};

std::optional<Across> AcrossOf(const FitView& view) {
  const auto has = [&](MapQuantity quantity) {
    return std::ranges::any_of(view.estimate.friction->maps, [&](const FrictionMap& map) {
      return FindAxis(map, quantity) != nullptr;
    });
  };
  // a map over the motor's angle goes first, otherwise one over the joint's position
  if (has(MapQuantity::motor_position)) return Across{true, AngleAxis("motor angle (rad)")};
  if (!has(MapQuantity::position)) return std::nullopt;
  const auto [lower, upper] = RangeOf({view.position});
  return Across{false, {PositionLabel(view), lower, upper}};
}

/// Whether the joint moved about so fast at a place, [kRows x kColumns]: at its kept samples, and between two of them that
/// follow each other.
using Passed = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>;
Passed PassedCells(const FitView& view, const Across& across, double fastest) {
  constexpr double kSpare = 0.1;  // of a speed: over so little no friction changes much
  Passed passed = Passed::Constant(kRows, kColumns, false);
  const Eigen::VectorXd& angle = across.Of(view);
  const double lower = across.axis.lower, width = across.axis.upper - lower;
  const auto column_of = [&](Eigen::Index i) {
    const auto column = static_cast<Eigen::Index>(kColumns * (angle[i] - lower) / width);
    return std::clamp<Eigen::Index>(column, 0, kColumns - 1);
  };
  const auto row_of = [&](double velocity) {
    const auto row = static_cast<Eigen::Index>(kRows * (velocity / fastest + 1) / 2);
    return std::clamp<Eigen::Index>(row, 0, kRows - 1);
  };
  for (Eigen::Index i = 0; i < view.time.size(); ++i) {
    const double v = view.velocity[i];
    if (!view.selection.keep[i] || v == 0) continue;
    const Eigen::Index here = column_of(i);
    const bool follows = i > 0 && view.selection.keep[i - 1];
    Eigen::Index before = follows ? column_of(i - 1) : here;
    // a motor's angle begins anew after each turn
    if (std::abs(here - before) > kColumns / 2) before = here;
    // columns that were crossed between two samples count too
    const Eigen::Index left = std::min(here, before), columns = std::abs(here - before) + 1;
    const Eigen::Index near = row_of((1 - kSpare) * v), far = row_of((1 + kSpare) * v);
    passed.block(std::min(near, far), left, std::abs(far - near) + 1, columns) = true;
  }
  return passed;
}

/// sign(v) F with its rows at velocities from -fastest to fastest; NaN where the joint did not move about
/// so fast at that place.
HeatMap LevelMap(const FitView& view, const Across& across, double energy) {
  const double fastest = KeptOf(view, view.velocity).cwiseAbs().maxCoeff();
  HeatMap map{Eigen::MatrixXd(kRows, kColumns),
              {across.axis.lower, across.axis.upper},
              {-fastest, fastest},
              {0, 1},
              TorqueLabel(view, "sign(v) · friction")};
  // a map over the motor's angle is shown at the mean position of the joint
  const double middle = KeptOf(view, view.position).mean();
  const Passed passed = PassedCells(view, across, fastest);
  const JointFriction sliding(*view.estimate.friction);
  // the level of steady friction at the middle of each cell
  for (Eigen::Index row = 0; row < kRows; ++row) {
    const double v = fastest * (2 * (static_cast<double>(row) + 0.5) / kRows - 1);
    for (Eigen::Index column = 0; column < kColumns; ++column) {
      const double share = (static_cast<double>(column) + 0.5) / kColumns;
      const double angle = across.axis.lower + share * (across.axis.upper - across.axis.lower);
      const JointPlace place{across.motor ? middle : angle, energy, 0, across.motor ? angle : 0};
      // empty where the joint never moved so
      map.values(row, column) =
          passed(row, column) ? Sign(v) * sliding.SlidingForce(v, place) : std::nan("");
    }
  }
  return map;
}

/// A direction's half of the map with its own colours, and the samples in it.
Plot PanelOf(const FitView& view, const Across& across, HeatMap map, int direction,
             const std::pair<double, double>& colours) {
  map.limits = colours;
  Plot plot;
  // one direction fills the panel
  plot.x = across.axis;
  plot.y = {SpeedLabel(view), direction > 0 ? 0 : map.y.first, direction > 0 ? map.y.second : 0};
  // dots show what the map rests on
  plot.series.push_back({"", Hue::text, map});
  plot.series.push_back({"samples", Hue::grey,
                         Scatter{KeptOf(view, across.Of(view)), KeptOf(view, view.velocity), 0.7,
                                 Marker::circle, 0.6}});
  return plot;
}

/// Lowest and highest level of one direction over all maps.
std::pair<double, double> ColoursOf(const std::vector<std::pair<std::string, HeatMap>>& maps,
                                    int direction) {
  std::vector<Eigen::VectorXd> all;
  for (const auto& [title, map] : maps) {
    const Eigen::MatrixXd half =
        direction > 0 ? map.values.bottomRows(kRows / 2) : map.values.topRows(kRows / 2);
    all.emplace_back(half.reshaped());
  }
  return RangeOf(all);
}

}  // namespace

std::optional<Figure> MakeFrictionMap(const FitView& view) {
  if (!view.has_fit || view.selection.count() == 0) return std::nullopt;
  const std::optional<Across> across = AcrossOf(view);
  if (!across) return std::nullopt;

  // cold, and at its warmest where the joint warms
  std::vector<std::pair<std::string, HeatMap>> maps{{"cold", LevelMap(view, *across, 0)}};
  if (view.warms()) {
    const double warmest = WarmestEnergy(view);
    maps.emplace_back(fmt::format("warmest: E = {} {}", SignificantText(warmest), view.torque_unit),
                      LevelMap(view, *across, warmest));
  }

  // title and origin, with what the empty places mean; cold beside warm
  Figure figure = WithoutPanels(
      {"friction_map",
       fmt::format("Friction over {} and velocity", across->motor ? "motor angle" : "position"),
       OriginOf(view) + "; empty where the joint did not move about so fast", "Friction"},
      maps.size());
  // in words: how far friction reaches over the map
  for (const auto& [title, map] : maps) {
    const auto [lowest, highest] = RangeOf({map.values.reshaped()});
    figure.finding +=
        fmt::format(" {} {} to {} {},", &map == &maps[0].second ? "cold" : "warm",
                    SignificantText(lowest), SignificantText(highest), view.torque_unit);
  }
  figure.finding.back() = '.';
  // a row for each direction, with colours that cold and warm share
  for (int direction : {1, -1}) {
    const auto [lowest, highest] = ColoursOf(maps, direction);
    if (!std::isfinite(lowest)) continue;  // it never moved so
    const std::pair<double, double> colours{lowest, highest > lowest ? highest : lowest + 1};
    for (const auto& [name, map] : maps) {
      const std::string title =
          fmt::format("{}, {}", direction > 0 ? "Forwards" : "Backwards", name);
      AddPanel(figure, title, PanelOf(view, *across, map, direction, colours), 260);
    }
  }
  if (figure.panels.empty()) return std::nullopt;
  return figure;
}

}  // namespace warmjoint::figures
