#include <warmjoint/friction.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "models/friction/laws.h"
#include "models/friction/parameter_rows.h"

namespace warmjoint {
namespace {

/// A level beyond so many times the load is a number that slipped.
constexpr double kLargestLoadGain = 100;

/// The width of one spacing; of the range's own size where there is one centre alone.
double Spacing(double first, double last, int count) {
  if (count > 1) return (last - first) / (count - 1);
  return last != first ? std::abs(last - first) : 1;
}

template <typename L>
Law Describe() {
  return {L::name,
          L::equation,
          L::parameters,
          &L::template Force<double>,
          [](int side, const double* p) { return HoldingLevelOf<L>(side, 0, p); },
          L::pre_sliding};
}

template <typename... L>
std::vector<Law> DescribeAll(LawList<L...>) {
  return {Describe<L>()...};
}

}  // namespace

const std::vector<Law>& Laws() {
  static const std::vector<Law> laws = DescribeAll(AllLaws{});
  return laws;
}

const Law* FindLaw(std::string_view name) {
  for (const Law& law : Laws()) {
    if (law.name == name) return &law;
  }
  return nullptr;
}

std::vector<std::string> LawNames() {
  std::vector<std::string> names;
  for (const Law& law : Laws()) names.emplace_back(law.name);
  return names;
}

LawPart PartOf(std::string_view name) {
  for (const Law& law : Laws()) {
    const auto found = std::ranges::find(law.parameters, name, &ParameterInfo::name);
    if (found != law.parameters.end()) return found->part;
  }
  return LawPart::other;
}

std::optional<size_t> PlaceOf(LawPart part, const Law& law) {
  const auto found = std::ranges::find(law.parameters, part, &ParameterInfo::part);
  if (found == law.parameters.end()) return std::nullopt;
  return static_cast<size_t>(found - law.parameters.begin());
}

GaussianAxis EvenAxis(double first, double last, int count) {
  GaussianAxis axis;
  axis.width = Spacing(first, last, count);
  for (int i = 0; i < count; ++i) axis.centres.push_back(first + i * axis.width);
  return axis;
}

GaussianAxis CircleAxis(double period, int count) {
  GaussianAxis axis;
  axis.width = period / count;
  axis.period = period;
  for (int i = 0; i < count; ++i) axis.centres.push_back(i * axis.width);
  return axis;
}

GaussianAxis SpeedAxis(double lowest, double highest, int count) {
  GaussianAxis axis;
  axis.sides = Sides::apart;
  axis.width = Spacing(lowest, highest, count);
  // the same speeds in both directions, ascending
  for (int i = count - 1; i >= 0; --i) axis.centres.push_back(-(lowest + i * axis.width));
  for (int i = 0; i < count; ++i) axis.centres.push_back(lowest + i * axis.width);
  return axis;
}

std::span<const Word<MapQuantity>> WordsOf(MapQuantity) {
  static constexpr std::array words{
      Word{"position", MapQuantity::position}, Word{"motor_position", MapQuantity::motor_position},
      Word{"velocity", MapQuantity::velocity}, Word{"energy", MapQuantity::energy},
      Word{"load", MapQuantity::load}};
  return words;
}

std::span<const Word<MapFactor>> WordsOf(MapFactor) {
  static constexpr std::array words{Word{"one", MapFactor::one},
                                    Word{"direction", MapFactor::direction},
                                    Word{"velocity", MapFactor::velocity}};
  return words;
}

size_t FrictionMap::size() const {
  size_t count = 1;
  for (const MapAxis& axis : axes) count *= axis.kernels.size();
  return count;
}

const MapAxis* FindAxis(const FrictionMap& map, MapQuantity quantity) {
  const auto found = std::ranges::find(map.axes, quantity, &MapAxis::quantity);
  return found == map.axes.end() ? nullptr : &*found;
}

std::span<const FrictionOption> FrictionOptions() {
  // each option with its name, symbol, unit, bounds and default
  static const std::array options{
      FrictionOption{{"level_per_temperature", "kT", kLevelPerTemperatureUnit, -kInfinity,
                      kInfinity, 0, "change of the level for each K of the ambient, once settled"},
                     &Friction::level_per_temperature},
      FrictionOption{{"viscous_per_energy", "b", kTimePerPositionUnit, -kInfinity, kInfinity, 0,
                      "(27) change of viscous for each unit of the energy state"},
                     &Friction::viscous_per_energy},
      FrictionOption{{"load_gain",
                      "c",
                      {"1", "1"},
                      0,
                      kLargestLoadGain,
                      0,
                      "growth of the level for each unit of the load's size"},
                     &Friction::load_gain},
  };
  return options;
}

void FillDefaults(Friction& friction) {
  const Law* law = FindLaw(friction.law);
  if (!law) return;
  for (const ParameterInfo& info : law->parameters) {
    // a number that must always be given has no default
    if (info.given == Given::always) continue;
    friction.parameters.try_emplace(std::string(info.name), info.default_value);
  }
}

std::vector<double> LawValues(const Friction& friction) {
  std::vector<double> values;
  for (const ParameterInfo& info : FindLaw(friction.law)->parameters) {
    values.push_back(friction.parameters.at(std::string(info.name)));
  }
  return values;
}

}  // namespace warmjoint
