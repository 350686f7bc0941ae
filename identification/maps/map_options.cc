#include "identification/maps/map_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace warmjoint {
namespace {

Eigen::VectorXd Column(MapQuantity quantity, const MapPoints& points) {
  return points.col(static_cast<int>(quantity));
}

// of ln |v|; why: speeds nearer to each other count as one, as for friction at speeds (make_bands.cc), and a group
// whose ends differ by more than twice that was not held
constexpr double kOneSpeed = 0.2;

/// Speeds that a log holds, ascending, those next to each other in ratio as one where there are more than `most`; none where
/// the joint moves at all speeds. speed: [n] of the samples, rad/s or m/s, above 0
std::vector<double> HeldSpeeds(Eigen::VectorXd speed, std::size_t most) {
  struct Group {
    double lowest, highest, sum, count;
    double mean() const { return sum / count; }
  };
  std::ranges::sort(speed);
  std::vector<Group> groups;
  for (const double v : speed) {
    if (groups.empty() || std::log(v / groups.back().highest) > kOneSpeed) {
      groups.push_back({v, v, 0, 0});
    }
    groups.back().highest = v;
    groups.back().sum += v;
    groups.back().count += 1;
  }
  const auto is_wide = [](const Group& one) {
    return std::log(one.highest / one.lowest) > 2 * kOneSpeed;
  };
  if (std::ranges::any_of(groups, is_wide)) return {};

  // the nearest two become one
  while (groups.size() > most) {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i + 1 < groups.size(); ++i) {
      const auto ratio = [&](std::size_t k) { return groups[k + 1].mean() / groups[k].mean(); };
      if (ratio(i) < ratio(nearest)) nearest = i;
    }
    groups[nearest].sum += groups[nearest + 1].sum;
    groups[nearest].count += groups[nearest + 1].count;
    groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(nearest) + 1);
  }
  std::vector<double> means;
  for (const Group& one : groups) means.push_back(one.mean());
  return means;
}

// of the least distance between two speeds; why: the kernels of others are 1 % at each, and between two speeds, where the
// log says nothing, a normalised map holds the value of the nearer
constexpr double kNarrow = 1.0 / 3;

/// Centres at these speeds, separately for both directions of motion.
GaussianAxis AxisAt(const std::vector<double>& speeds) {
  GaussianAxis axis;
  axis.sides = Sides::apart;
  axis.width = speeds.back();
  for (std::size_t i = 0; i + 1 < speeds.size(); ++i) {
    axis.width = std::min(axis.width, kNarrow * (speeds[i + 1] - speeds[i]));
  }
  for (std::size_t i = speeds.size(); i-- > 0;) axis.centres.push_back(-speeds[i]);
  axis.centres.insert(axis.centres.end(), speeds.begin(), speeds.end());
  return axis;
}

}  // namespace

MapAxis RangeAxis(MapQuantity quantity, const MapPoints& points, int count, double width) {
  const Eigen::VectorXd x = Column(quantity, points);
  MapAxis axis{quantity, EvenAxis(x.minCoeff(), x.maxCoeff(), count)};
  axis.kernels.width *= width;
  return axis;
}

MapAxis VelocityAxis(const MapPoints& points, int count, double width) {
  const Eigen::VectorXd speed = Column(MapQuantity::velocity, points).cwiseAbs();
  const double lowest = speed.minCoeff(), highest = speed.maxCoeff();
  const bool one = count == 1 || !(highest - lowest > 1e-6 * highest);
  if (one) {
    MapAxis axis{MapQuantity::velocity, SpeedAxis(highest, highest, 1)};
    // one kernel a side is 1 on its side, plain or not
    axis.kernels.width *= 1e6;
    return axis;
  }
  const std::vector<double> held = HeldSpeeds(speed, static_cast<std::size_t>(count));
  if (held.size() > 1) return {MapQuantity::velocity, AxisAt(held)};
  MapAxis axis{MapQuantity::velocity, SpeedAxis(lowest, highest, count)};
  axis.kernels.width *= width;
  return axis;
}

MapAxis TurnAxis(MapQuantity angle, int count, double width) {
  MapAxis axis{angle, CircleAxis(2 * std::numbers::pi, count)};
  axis.kernels.width *= width;
  return axis;
}

FrictionMap PositionMap(const MapPoints& points, KernelKind kernels, int count, double width,
                        int speeds) {
  FrictionMap map{{RangeAxis(MapQuantity::position, points, count, width)}, kernels, {}};
  if (speeds > 0) map.axes.push_back(VelocityAxis(points, speeds, width));
  return map;
}

MapShapes PositionMaps(const Options& options, const MapPoints& points) {
  const auto& made = options.Get<MapOptions>();
  const auto& [basis, kernels, velocity_kernels] = options.Get<PositionMapOptions>();
  const std::vector<int> counts =
      kernels > 0 ? std::vector{kernels} : std::vector{10, 20, 40, 80, 128};
  // centres over speed in each direction; none where both directions share the map
  const int speeds = basis == MapBasis::position   ? 0
                     : basis == MapBasis::velocity ? velocity_kernels
                                                   : 1;
  MapShapes candidates;
  for (const int count : counts) {
    for (const double width : made.Widths()) {
      candidates.push_back({PositionMap(points, made.kernel, count, width, speeds)});
    }
  }
  return candidates;
}

std::optional<std::string> CannotCarry(MapQuantity quantity, const MapPoints& points) {
  const Eigen::VectorXd x = Column(quantity, points);
  const std::string_view name = NameOf(quantity);
  if (!x.allFinite()) {
    return fmt::format("{} is not a finite number at some sample; repair or remove it", name);
  }
  const double range = x.maxCoeff() - x.minCoeff();
  if (!(range > 1e-9 * x.cwiseAbs().maxCoeff())) {
    return fmt::format(
        "{} is {:.6g} at all samples, so that no map over it can be estimated; vary it", name,
        x[0]);
  }
  return std::nullopt;
}

}  // namespace warmjoint
