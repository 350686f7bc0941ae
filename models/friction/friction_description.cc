#include "models/friction/friction_description.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "models/foundation/nearest_name.h"
#include "models/foundation/read_json.h"

namespace warmjoint {
namespace {

using nlohmann::json;

void CheckValue(const ParameterInfo& info, double value, const Place& place) {
  if (std::isfinite(value) && value >= info.lower && value <= info.upper) return;
  Refuse(place, "{} is {}; it must be a finite number from {} to {} ({})", info.name, value,
         info.lower, info.upper, info.unit.rotary);
}

/// A joint at rest cannot bear less than a sliding one.
void CheckStaticLevel(const FrictionDescription& friction, const Place& place) {
  const auto at_rest = friction.parameters.find("static");
  if (at_rest == friction.parameters.end()) return;
  const double coulomb = friction.parameters.at("coulomb");
  if (at_rest->second >= coulomb) return;
  Refuse(place, "static is {}; it must be at least coulomb, {}: a joint at rest bears no less",
         at_rest->second, coulomb);
}

double NumberMember(const json& object, const std::string& key, const Place& place) {
  const json& value = object.at(key);
  if (!value.is_number()) Refuse(place, "{} is {}; it must be a number", key, value.dump());
  return value.get<double>();
}

void RefuseUnknownKeys(const json& object, const std::string& what,
                       const std::vector<std::string>& known, const Place& place) {
  if (!object.is_object()) Refuse(place, "{} is {}; it must be an object", what, object.dump());
  for (const auto& [key, value] : object.items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    Refuse(place, "{} has no key '{}'{}", what, key, Suggestion(key, known));
  }
}

void ReadThermal(const json& object, FrictionDescription& friction, const Place& place) {
  RefuseUnknownKeys(object, "thermal", {"thermal_gain", "thermal_time_constant", "ambient"}, place);
  for (const char* key : {"thermal_gain", "thermal_time_constant"}) {
    if (!object.contains(key)) Refuse(place, "thermal lacks {}; give a number", key);
  }
  friction.thermal = Thermal{NumberMember(object, "thermal_gain", place),
                             NumberMember(object, "thermal_time_constant", place)};
  if (object.contains("ambient")) friction.ambient = NumberMember(object, "ambient", place);
}

}  // namespace

void CheckFriction(const FrictionDescription& friction, const Place& place) {
  const Law* law = FindLaw(friction.law);
  if (!law) {
    Refuse(place, "there is no law '{}'{}", friction.law, Suggestion(friction.law, LawNames()));
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
    Refuse(place, "law {} has no parameter '{}'{}", law->name, name, Suggestion(name, known));
  }

  CheckStaticLevel(friction, place);
  if (friction.thermal) {
    CheckValue(Thermal::parameters[0], friction.thermal->gain, place);
    CheckValue(Thermal::parameters[1], friction.thermal->time_constant, place);
    if (friction.thermal->time_constant == 0) {
      Refuse(place, "thermal_time_constant is 0 s; it must be positive");
    }
  }
  if (!std::isfinite(friction.gear) || friction.gear == 0) {
    Refuse(place, "gear is {}; it must be a finite number other than 0", friction.gear);
  }
  for (const FrictionMap& map : friction.maps) CheckMap(map, place);
}

void FillDefaults(FrictionDescription& friction) {
  const Law* law = FindLaw(friction.law);
  if (!law) return;
  for (const ParameterInfo& info : law->parameters) {
    if (info.given == Given::always) continue;
    friction.parameters.try_emplace(std::string(info.name), info.default_value);
  }
}

std::vector<double> LawValues(const FrictionDescription& friction) {
  std::vector<double> values;
  for (const ParameterInfo& info : FindLaw(friction.law)->parameters) {
    values.push_back(friction.parameters.at(std::string(info.name)));
  }
  return values;
}

json FrictionToJson(const FrictionDescription& friction) {
  json result{{"law", friction.law}, {"parameters", friction.parameters}, {"gear", friction.gear}};
  if (friction.thermal) {
    result["thermal"] = {{"thermal_gain", friction.thermal->gain},
                         {"thermal_time_constant", friction.thermal->time_constant},
                         {"ambient", friction.ambient}};
  }
  for (const FrictionMap& map : friction.maps) result["maps"].push_back(MapToJson(map));
  return result;
}

FrictionDescription FrictionFromJson(const json& object, const Place& place) {
  RefuseUnknownKeys(object, "friction", {"law", "parameters", "thermal", "gear", "maps"}, place);
  if (!object.contains("law") || !object["law"].is_string()) {
    Refuse(place, "friction lacks its law; give one of its names as text");
  }

  FrictionDescription friction;
  friction.law = object["law"].get<std::string>();
  if (object.contains("parameters")) {
    const json& parameters = object["parameters"];
    if (!parameters.is_object()) Refuse(place, "friction's parameters must be an object");
    for (const auto& [name, value] : parameters.items()) {
      friction.parameters[name] = NumberMember(parameters, name, place);
    }
  }
  if (object.contains("thermal")) ReadThermal(object["thermal"], friction, place);
  if (object.contains("gear")) friction.gear = NumberMember(object, "gear", place);
  if (object.contains("maps")) {
    if (!object["maps"].is_array()) Refuse(place, "friction's maps must be a list");
    for (const json& map : object["maps"]) friction.maps.push_back(MapFromJson(map, place));
  }
  FillDefaults(friction);
  CheckFriction(friction, place);
  return friction;
}

FrictionDescription ReadFrictionFile(const std::string& path) {
  const json object = ReadJsonFile(path);
  return FrictionFromJson(object.contains("friction") ? object["friction"] : object, {path});
}

}  // namespace warmjoint
