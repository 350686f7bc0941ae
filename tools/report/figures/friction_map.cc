#include "tools/report/figures/friction_map.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tools/report/draw/frame.h"
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
  // a map over the motor's angle goes first
  for (const FrictionMap& map : view.estimate.friction->maps) {
    if (FindAxis(map, MapQuantity::motor_position)) {
      return Across{MapQuantity::motor_position, AngleAxis("motor angle (rad)")};
    }
  }
  // otherwise one over the joint's position
  for (const FrictionMap& map : view.estimate.friction->maps) {
    if (!FindAxis(map, MapQuantity::position)) continue;
    const auto [lower, upper] = RangeOf({view.position});
    return Across{MapQuantity::position, {PositionLabel(view), lower, upper, Scale::linear, {}}};
  }
  return std::nullopt;
}

/// Speeds at which the joint passed a column of the map, rad/s or m/s; none where it never did.
struct Passage {
  double slowest = std::numeric_limits<double>::infinity();
  double fastest = 0;

  /// Whether a speed is among them, or hardly another.
  bool Holds(double speed) const {
    constexpr double spare = 0.1;  // of a speed: over so little no friction changes much
    return speed >= (1 - spare) * slowest && speed <= (1 + spare) * fastest;
  }
};

/// The passages of a direction by column: those of its kept samples, and of what lies between two of them
/// that follow each other.
std::vector<Passage> Passages(const FitView& view, const Across& across, int direction) {
  std::vector<Passage> passages(kColumns);
  const Eigen::VectorXd& angle =
      across.quantity == MapQuantity::motor_position ? view.motor_angle : view.position;
  const auto column_of = [&](Eigen::Index i) {
    const auto column = static_cast<Eigen::Index>(kColumns * ShareOf(across.axis, angle[i]));
    return std::clamp<Eigen::Index>(column, 0, kColumns - 1);
  };
  // each kept sample widens the speeds that the joint passed here with
  for (Eigen::Index i = 0; i < view.time.size(); ++i) {
    const double speed = view.velocity[i] * direction;
    if (!view.selection.keep[i] || speed <= 0) continue;
    const Eigen::Index here = column_of(i);
    const bool follows = i > 0 && view.selection.keep[i - 1];
    Eigen::Index before = follows ? column_of(i - 1) : here;
    // a motor's angle begins anew after each turn
    if (std::abs(here - before) > kColumns / 2) before = here;
    // columns that were crossed between two samples count too
    for (Eigen::Index c = std::min(here, before); c <= std::max(here, before); ++c) {
      Passage& passage = passages[static_cast<std::size_t>(c)];
      passage.slowest = std::min(passage.slowest, speed);
      passage.fastest = std::max(passage.fastest, speed);
    }
  }
  return passages;
}

/// sign(v) F with its rows at velocities from -fastest to fastest; NaN where the joint never moved so
/// fast or so slowly at that place.
HeatMap LevelMap(const FitView& view, const Across& across, double energy) {
  const double fastest = KeptOf(view, view.velocity).cwiseAbs().maxCoeff();
  HeatMap map{Eigen::MatrixXd(kRows, kColumns),
              {across.axis.lower, across.axis.upper},
              {-fastest, fastest},
              {0, 1},
              TorqueLabel(view, "sign(v) · friction")};
  // a map over the motor's angle is shown at the mean position of the joint
  const double middle = KeptOf(view, view.position).mean();
  const std::vector<Passage> forwards = Passages(view, across, 1),
                             backwards = Passages(view, across, -1);
  const JointFriction sliding(*view.estimate.friction);
  // the level of steady friction at the middle of each cell
  for (Eigen::Index row = 0; row < kRows; ++row) {
    const double v = fastest * (2 * (static_cast<double>(row) + 0.5) / kRows - 1);
    for (Eigen::Index column = 0; column < kColumns; ++column) {
      const double share = (static_cast<double>(column) + 0.5) / kColumns;
      const double angle = across.axis.lower + share * (across.axis.upper - across.axis.lower);
      const bool over_motor = across.quantity == MapQuantity::motor_position;
      const JointPlace place{over_motor ? middle : angle, energy, 0, over_motor ? angle : 0};
      // empty where the joint never moved so
      const Passage& passage = (v > 0 ? forwards : backwards)[static_cast<std::size_t>(column)];
      map.values(row, column) =
          passage.Holds(std::abs(v)) ? Sign(v) * sliding.SlidingForce(v, place) : std::nan("");
    }
  }
  return map;
}

/// A direction's half of the map with its own colours, and the samples in it.
Plot PanelOf(const FitView& view, const Across& across, HeatMap map, int direction,
             const std::pair<double, double>& colours) {
  map.colours = colours;
  const Eigen::VectorXd& angle =
      across.quantity == MapQuantity::motor_position ? view.motor_angle : view.position;
  Plot plot;
  // one direction fills the panel
  plot.x = across.axis;
  plot.y = {SpeedLabel(view),
            direction > 0 ? 0 : map.y.first,
            direction > 0 ? map.y.second : 0,
            Scale::linear,
            {}};
  // dots show what the map rests on
  plot.series.push_back({"", Hue::text, map});
  plot.series.push_back(
      {"samples", Hue::grey,
       Scatter{KeptOf(view, angle), KeptOf(view, view.velocity), 0.7, Marker::circle, 0.6}});
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

  // title and origin, with what the empty places mean
  Figure figure;
  figure.name = "friction_map";
  const bool motor = across->quantity == MapQuantity::motor_position;
  figure.title = fmt::format("Friction over {} and velocity", motor ? "motor angle" : "position");
  figure.subtitle = OriginOf(view) + "; empty where the joint never moved so";
  // in words: how far friction reaches over the map
  const auto range = [](const HeatMap& map) { return RangeOf({map.values.reshaped()}); };
  figure.finding = "Friction";
  for (const auto& [title, map] : maps) {
    figure.finding += fmt::format(" {} {} to {} {},", &map == &maps[0].second ? "cold" : "warm",
                                  SignificantText(range(map).first),
                                  SignificantText(range(map).second), view.torque_unit);
  }
  figure.finding.back() = '.';
  figure.height = 0;
  figure.rows.clear();
  figure.columns.assign(maps.size(), 1);
  // a row for each direction, with colours that cold and warm share
  for (int direction : {1, -1}) {
    const auto [lowest, highest] = ColoursOf(maps, direction);
    if (!std::isfinite(lowest)) continue;  // it never moved so
    const std::pair<double, double> colours{lowest, highest > lowest ? highest : lowest + 1};
    // cold beside warm
    const auto row = static_cast<int>(figure.rows.size());
    figure.rows.push_back(260);
    for (std::size_t i = 0; i < maps.size(); ++i) {
      const std::string title =
          fmt::format("{}, {}", direction > 0 ? "Forwards" : "Backwards", maps[i].first);
      figure.panels.push_back({title, PanelOf(view, *across, maps[i].second, direction, colours),
                               row, static_cast<int>(i)});
    }
  }
  if (figure.panels.empty()) return std::nullopt;
  return figure;
}

}  // namespace warmjoint::report
