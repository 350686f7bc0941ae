#include "models/friction/friction_json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "models/foundation/excerpt.h"
#include "models/foundation/serialize.h"
#include "models/friction/level_terms.h"
#include "models/friction/parameter_rows.h"
#include "models/friction/thermal.h"

namespace warmjoint {
namespace {

void CheckPositive(double value, std::string_view axis, const char* what, const Place& place) {
  if (std::isfinite(value) && value > 0) return;
  Refuse(place, "map axis {} has the {} {}; it must be a positive number", axis, what, value);
}

void CheckAxis(const MapAxis& axis, const Place& place) {
  const std::string_view name = NameOf(axis.quantity);
  const GaussianAxis& kernels = axis.kernels;
  // few enough kernels, of a positive width
  if (kernels.size() < 1 || kernels.size() > kMostMapCentres) {
    Refuse(place, "map axis {} has {} centres; give 1 to {}", name, kernels.size(),
           kMostMapCentres);
  }
  CheckPositive(kernels.width, name, "width", place);
  if (kernels.period) CheckPositive(*kernels.period, name, "period", place);
  // ascending centres; with the sides apart, each on one of them
  for (size_t i = 0; i < kernels.size(); ++i) {
    const double centre = kernels.centres[i];
    if (!std::isfinite(centre) || (i > 0 && centre <= kernels.centres[i - 1])) {
      Refuse(place, "map axis {} has centre {} at place {}; centres must be finite and ascend",
             name, centre, i);
    }
    if (kernels.sides == Sides::apart && centre == 0) {
      Refuse(place, "map axis {} has a centre at 0 and its sides apart; move it to one side", name);
    }
  }
}

void CheckValue(const ParameterInfo& info, double value, const Place& place) {
  if (std::isfinite(value) && value >= info.lower && value <= info.upper) return;
  const bool bounded = info.lower != -kInfinity || info.upper != kInfinity;
  const std::string bounds =
      bounded ? fmt::format(" from {} to {}", info.lower, info.upper) : std::string();
  Refuse(place, "{} is {}; it must be a finite number{} ({})", info.name, value, bounds,
         info.unit.rotary);
}

/// A joint at rest cannot bear less than a sliding one.
void CheckStaticLevel(const Friction& friction, const Place& place) {
  // only laws with a level at rest of its own can contradict themselves
  const Law& law = *FindLaw(friction.law);
  const std::optional<size_t> at_rest = PlaceOf(LawPart::rest_level, law);
  if (!at_rest) return;
  const std::vector<double> values = LawValues(friction);
  const size_t sliding = *PlaceOf(LawPart::level, law);
  if (values[*at_rest] >= values[sliding]) return;
  Refuse(place, "{} is {}; it must be at least {}, {}: a joint at rest bears no less",
         law.parameters[*at_rest].name, values[*at_rest], law.parameters[sliding].name,
         values[sliding]);
}

void CheckThermal(const Thermal& thermal, const Place& place) {
  CheckValue(Thermal::parameters[0], thermal.gain, place);
  if (std::abs(thermal.gain) > kLargestThermalGain) {
    Refuse(place, "thermal_gain is {}; it must be from {} to {} (N.m/W)", thermal.gain,
           -kLargestThermalGain, kLargestThermalGain);
  }
  CheckValue(Thermal::parameters[1], thermal.time_constant, place);
  if (thermal.time_constant > 0) return;
  Refuse(place, "thermal_time_constant is 0 s; it must be positive");
}

/// What depends on the heat makes sense only where there is heat.
void CheckHeat(const Friction& friction, const Place& place) {
  // warming must be physical, and the temperature act in its direction
  if (friction.thermal) {
    CheckThermal(*friction.thermal, place);
    if (friction.level_per_temperature * friction.thermal->gain < 0) {
      Refuse(place,
             "level_per_temperature is {} and thermal_gain {}: losses would cool the joint; their "
             "signs must agree",
             friction.level_per_temperature, friction.thermal->gain);
    }
    if (friction.second_thermal) CheckThermal(*friction.second_thermal, place);
    return;
  }

  // without warming, nothing may depend on it
  const auto needs = [&](const char* what) {
    Refuse(place, "{} needs thermal, which is not given; give it a gain and a time constant", what);
  };
  if (friction.second_thermal) needs("a second stage of warming");
  if (friction.level_per_temperature != 0) needs("level_per_temperature");
  if (friction.viscous_per_energy != 0) needs("viscous_per_energy");
  for (const FrictionMap& map : friction.maps) {
    if (FindAxis(map, MapQuantity::energy)) needs("a map over energy");
  }
}

/// Eq. (27): a slope that rises with the loss that it causes has no bound.
void CheckSlopeOverEnergy(const Friction& friction, const Place& place) {
  const double slope = friction.viscous_per_energy;
  if (slope == 0) return;
  if (!PlaceOf(LawPart::slope, *FindLaw(friction.law))) {
    Refuse(place, "viscous_per_energy is {}, but law {} has no {} that it could change", slope,
           friction.law, kViscousRow.name);
  }
  // either stage of warming could run away
  for (const auto& thermal : {friction.thermal, friction.second_thermal}) {
    if (!thermal || slope * thermal->gain <= 0) continue;
    Refuse(place,
           "viscous_per_energy is {} and thermal_gain {}: the slope would rise with its own losses "
           "without a bound; their signs must differ",
           slope, thermal->gain);
  }
}

void CheckMaps(const Friction& friction, const Place& place) {
  double work = 0;
  for (const FrictionMap& map : friction.maps) {
    CheckMap(map, place);
    // all maps are sampled before the first step, which must end soon
    work += SurveyWork(map);
    if (work > kMostSurveyWork) {
      Refuse(place,
             "its maps need {:.1g} evaluations of kernels before the first step, more than {:.1g}; "
             "give that of {} weights "
             "fewer axes or fewer centres",
             work, kMostSurveyWork, map.size());
    }
    for (const MapAxis& axis : map.axes) {
      if (axis.quantity != MapQuantity::motor_position) continue;
      const double period = axis.kernels.period.value_or(0);
      if (std::abs(period - 2 * std::numbers::pi) <= 1e-9) continue;
      Refuse(place,
             "a map over motor_position has the period {}; the motor's angle lies on a circle, so "
             "that it must be 2 pi, {}",
             period, 2 * std::numbers::pi);
    }
  }
}

}  // namespace

void CheckMap(const FrictionMap& map, const Place& place) {
  // few axes, kernels on each, and a finite weight for each product of kernels
  if (map.axes.empty() || map.axes.size() > kMostMapAxes) {
    Refuse(place, "a map has {} axes; give 1 to {}", map.axes.size(), kMostMapAxes);
  }
  for (const MapAxis& axis : map.axes) CheckAxis(axis, place);
  if (map.weights.size() != map.size()) {
    Refuse(place, "a map has {} weights; its axes span {} kernels", map.weights.size(), map.size());
  }
  for (const double weight : map.weights) {
    if (!std::isfinite(weight)) Refuse(place, "a map has the weight {}; give numbers", weight);
  }
}

void CheckFriction(const Friction& friction, const Place& place) {
  const Law* law = FindLaw(friction.law);
  if (!law) {
    Refuse(place, "there is no law '{}'{}", Excerpt(friction.law),
           Suggestion(friction.law, LawNames()));
  }

  // each parameter of the law once, and no other
  std::vector<std::string> known;
  for (const ParameterInfo& info : law->parameters) {
    known.emplace_back(info.name);
    const auto found = friction.parameters.find(known.back());
    if (found == friction.parameters.end()) {
      Refuse(place, "law {} lacks its parameter {} ({})", law->name, info.name, info.meaning);
    }
    CheckValue(info, found->second, place);
  }
  for (const auto& [name, value] : friction.parameters) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    Refuse(place, "law {} has no parameter '{}'{}", law->name, Excerpt(name),
           Suggestion(name, known));
  }

  // what stands beside the law
  CheckStaticLevel(friction, place);
  for (const FrictionOption& option : FrictionOptions()) {
    CheckValue(option.info, friction.*option.value, place);
  }
  CheckHeat(friction, place);
  CheckSlopeOverEnergy(friction, place);
  if (!std::isfinite(friction.gear) || friction.gear == 0) {
    Refuse(place, "gear is {}; it must be a finite number other than 0", friction.gear);
  }
  CheckMaps(friction, place);
}

void CheckFriction(const Friction& friction) { CheckFriction(friction, {"friction"}); }

Friction Completed(Friction friction, const Place& place) {
  FillDefaults(friction);
  CheckFriction(friction, place);
  return friction;
}

Tree FrictionToTree(const Friction& friction) { return WriteFields(friction); }

Friction FrictionFrom(const Node& node) {
  Friction friction;
  ReadFields(node.With(UnknownKeys::refused), &friction);
  return Completed(std::move(friction), node.place());
}

void ReadValue(const Node& node, Friction* value, const FieldInfo&) { *value = FrictionFrom(node); }

std::vector<FrictionMap> MapsFrom(const Node& node) {
  std::vector<FrictionMap> maps;
  ReadValue(node, &maps, {});
  for (const FrictionMap& map : maps) CheckMap(map, node.place());
  return maps;
}

void RefuseAmperes(const Friction& friction, const Place& place) {
  if (friction.torque_unit.empty()) return;
  Refuse(place,
         "its friction is in {}, and a simulator needs torque: identify again with "
         "--torque-constant, the torque of the joint for each ampere",
         friction.torque_unit);
}

std::string FrictionToJson(const Friction& friction) {
  return FrictionToTree(Completed(friction, {"friction"})).dump(2) + "\n";
}

Friction FrictionFromJson(const std::string& text, const std::string& name) {
  return FrictionFrom(ParseJsonNode(text, name));
}

Friction ReadFriction(const std::filesystem::path& path) {
  const Node file = ReadJsonNode(path);
  // an estimate holds its friction under that name; else the file is one
  Friction friction = FrictionFrom(file.Find("friction").value_or(file));
  RefuseAmperes(friction, {path});
  return friction;
}

}  // namespace warmjoint
