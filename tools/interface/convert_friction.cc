#include "tools/interface/convert_friction.h"

#include "models/foundation/serialize.h"
#include "models/friction/check_friction.h"

namespace warmjoint::api {
namespace {

/// The choice of that name.
template <typename Choice>
Choice Named(const std::string& given, const char* what) {
  return models::ChoiceOf<Choice>(models::Node({{what, given}}, "friction").Require(what, ""));
}

std::optional<models::Thermal> ToThermal(const std::optional<Thermal>& thermal) {
  if (!thermal) return std::nullopt;
  return models::Thermal{thermal->gain, thermal->time_constant};
}

std::optional<Thermal> FromThermal(const std::optional<models::Thermal>& thermal) {
  if (!thermal) return std::nullopt;
  return Thermal{thermal->gain, thermal->time_constant};
}

models::FrictionMap ToMap(const FrictionMap& map) {
  models::FrictionMap made;
  // each axis with its kernels
  for (const MapAxis& axis : map.axes) {
    const auto sides = axis.sides_apart ? models::Sides::apart : models::Sides::together;
    made.axes.push_back({Named<models::MapQuantity>(axis.quantity, "quantity"),
                         {axis.centres, axis.width, axis.period, sides}});
  }

  // what the kernels are multiplied by
  made.kernels = map.normalised ? models::KernelKind::normalised : models::KernelKind::plain;
  made.factor = Named<models::MapFactor>(map.factor, "factor");
  made.weights = map.weights;
  return made;
}

FrictionMap FromMap(const models::FrictionMap& map) {
  FrictionMap made;
  // each axis with its kernels
  for (const models::MapAxis& axis : map.axes) {
    const models::GaussianAxis& kernels = axis.kernels;
    made.axes.push_back({std::string(models::NameOf(axis.quantity)), kernels.centres, kernels.width,
                         kernels.period, kernels.sides == models::Sides::apart});
  }

  // what the kernels are multiplied by
  made.normalised = map.kernels == models::KernelKind::normalised;
  made.factor = models::NameOf(map.factor);
  made.weights = map.weights;
  return made;
}

}  // namespace

models::FrictionDescription ToDescription(const Friction& friction) {
  models::FrictionDescription made;
  // the law and its warming
  made.law = friction.law;
  made.parameters = friction.parameters;
  made.thermal = ToThermal(friction.thermal);
  made.second_thermal = ToThermal(friction.second_thermal);

  // what joins any law
  made.ambient = friction.ambient;
  made.gear = friction.gear;
  made.level_per_temperature = friction.level_per_temperature;
  made.viscous_per_energy = friction.viscous_per_energy;
  made.load_gain = friction.load_gain;
  made.torque_unit = friction.torque_unit;
  for (const FrictionMap& map : friction.maps) made.maps.push_back(ToMap(map));

  // what is left out has a default; what remains must make sense together
  models::FillDefaults(made);
  models::CheckFriction(made, {"friction"});
  return made;
}

Friction FromDescription(const models::FrictionDescription& friction) {
  Friction made;
  // the law and its warming
  made.law = friction.law;
  made.parameters = friction.parameters;
  made.thermal = FromThermal(friction.thermal);
  made.second_thermal = FromThermal(friction.second_thermal);

  // what joins any law
  made.ambient = friction.ambient;
  made.gear = friction.gear;
  made.level_per_temperature = friction.level_per_temperature;
  made.viscous_per_energy = friction.viscous_per_energy;
  made.load_gain = friction.load_gain;
  made.torque_unit = friction.torque_unit;
  for (const models::FrictionMap& map : friction.maps) made.maps.push_back(FromMap(map));
  return made;
}

}  // namespace warmjoint::api
