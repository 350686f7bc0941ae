#include "identification/sentences/maps.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace warmjoint {
namespace {

std::string_view UnitOf(MapQuantity quantity, JointKind joint) {
  if (quantity == MapQuantity::position) return kPositionUnit.For(joint);
  if (quantity == MapQuantity::motor_position) return "rad";
  if (quantity == MapQuantity::velocity) return kVelocityUnit.For(joint);
  return kTorqueUnit.For(joint);
}

/// " backwards", " forwards at 0.5", " at energy -2 N.m": a velocity by its direction, other quantities with their unit.
std::string NameOfPlace(const LinePlace& place, JointKind joint) {
  if (place.over != MapQuantity::velocity) {
    return fmt::format(" at {} {:.3g} {}", NameOf(place.over), place.centre,
                       UnitOf(place.over, joint));
  }
  const char* direction = place.centre < 0 ? "backwards" : "forwards";
  if (place.is_direction) return fmt::format(" {}", direction);
  return fmt::format(" {} at {:.3g}", direction, std::abs(place.centre));
}

/// "20 position x 2 velocity kernels and 36 motor_position kernels".
std::string NameOfShape(const std::vector<FrictionMap>& maps) {
  std::vector<std::string> shapes;
  for (const FrictionMap& map : maps) {
    std::vector<std::string> axes;
    for (const MapAxis& axis : map.axes) {
      axes.push_back(fmt::format("{} {}", axis.kernels.size(), NameOf(axis.quantity)));
    }
    shapes.push_back(fmt::format("{} kernels", fmt::join(axes, " x ")));
  }
  return fmt::format("{}", fmt::join(shapes, " and "));
}

}  // namespace

std::string NameOfHole(const HoleRange& hole, const std::vector<LinePlace>& line, JointKind joint) {
  std::string name = fmt::format("{} {:.3g} to {:.3g} {}", NameOf(hole.quantity), hole.lower,
                                 hole.upper, UnitOf(hole.quantity, joint));
  for (const LinePlace& place : line) name += NameOfPlace(place, joint);
  return name;
}

std::string NameOfSmallerHoles(std::size_t count) { return fmt::format("{} smaller ones", count); }

std::string SummaryOfMaps(const FittedMaps& fitted) {
  return fmt::format(
      "law {} and {} on {} samples; prior of strength {:.3g} on their weights leaves {:.1f} "
      "effective parameters",
      fitted.law, NameOfShape(fitted.maps), fitted.samples, fitted.strength, fitted.effective);
}

std::string ExplainMapWithoutPositions(MapQuantity quantity) {
  return fmt::format(
      "the log has no positions, and a map over {} needs them; log them, or use nominal-ls or "
      "energy-ml",
      NameOf(quantity));
}

std::string ExplainMapBesideLoss(std::string_view position, std::string_view loss) {
  return fmt::format("position={} cannot be had together with loss={}; leave one of them out",
                     position, loss);
}

std::string ExplainHeldBesideMaps(const Unknown& parameter) {
  return fmt::format("noise puts {} beyond its bound {}, so it is set to that", parameter.name,
                     parameter.lower);
}

std::string ExplainImitated(const std::vector<std::string>& names) {
  return fmt::format(
      "the data cannot separate {} from the map; use total friction (at the speeds given, and "
      "bands), not {}",
      fmt::join(names, ", "), names.size() == 1 ? "this number" : "these numbers");
}

std::string ExplainDrivingFriction(const FrictionAtSpeed& at, const LogSamples& measurements,
                                   const Fit& fit) {
  return fmt::format(
      "the friction drives the joint: at {:.3g} {} it is {:.3g} {}; {} its sign reversed (--scale "
      "torque=-1)?",
      at.speed, kVelocityUnit.For(measurements.joint), at.value, measurements.torque_unit,
      fit.model.gravity ? "is" : "does the torque hold gravity (--gravity sincos), or is");
}

std::string ExplainHoles(const std::vector<std::string>& holes) {
  return fmt::format(
      "the map has no data at {}: it follows its neighbours there, and its bands are wide",
      fmt::join(holes, ", "));
}

std::string ExplainMotorRipple(bool forwards, const std::vector<std::pair<int, double>>& harmonics,
                               const std::string& unit) {
  std::string found;
  for (const auto& [multiple, amplitude] : harmonics) {
    found += fmt::format("{}{:.3g} {} at {} a turn", found.empty() ? "" : ", ", amplitude, unit,
                         multiple);
  }
  return fmt::format("motor ripple for v {} 0: {}", forwards ? ">" : "<",
                     found.empty() ? "none above the noise" : found);
}

std::string ExplainWithoutWarming(std::string_view why) {
  return fmt::format("without warming: {}", why);
}

std::string ExplainWarmingBesideMaps(int iterations) {
  return fmt::format("warming with them in {} iterations", iterations);
}

std::string ExplainMapsOverEnergy(int rounds) {
  return fmt::format(
      "the energy state is consistent with the losses of the fit after {} rounds; thermal_gain and "
      "thermal_time_constant have no interval, since maps over the energy absorb part of their "
      "effect",
      rounds);
}

}  // namespace warmjoint
