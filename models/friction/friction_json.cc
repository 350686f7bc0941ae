#include "models/friction/friction_json.h"

#include <nlohmann/json.hpp>

#include "models/foundation/json_members.h"
#include "models/foundation/read_json.h"
#include "models/friction/check_friction.h"
#include "models/friction/friction_map_json.h"
#include "models/friction/thermal.h"

namespace warmjoint::inline models {
namespace {

using nlohmann::json;

constexpr const char* kTorqueUnitKey = "torque_unit";

const std::string kGain(kGainName), kTimeConstant(kTimeConstantName);

double NumberMember(const json& object, const std::string& key, const Place& place) {
  return NumberFrom(object.at(key), key, place);
}

Thermal ThermalFromJson(const json& object, const Place& place) {
  for (const std::string& key : {kGain, kTimeConstant}) {
    if (!object.contains(key)) Refuse(place, "thermal lacks {}; give a number", key);
  }
  return {NumberMember(object, kGain, place), NumberMember(object, kTimeConstant, place)};
}

json ThermalToJson(const Thermal& thermal) {
  return {{kGain, thermal.gain}, {kTimeConstant, thermal.time_constant}};
}

void ReadThermal(const json& object, FrictionDescription& friction, const Place& place) {
  RefuseUnknownKeys(object, "thermal", {kGain, kTimeConstant, "ambient", "second"}, place);
  friction.thermal = ThermalFromJson(object, place);
  if (object.contains("ambient")) friction.ambient = NumberMember(object, "ambient", place);
  if (!object.contains("second")) return;
  RefuseUnknownKeys(object["second"], "thermal.second", {kGain, kTimeConstant}, place);
  friction.second_thermal = ThermalFromJson(object["second"], place);
}

}  // namespace

json FrictionToJson(const FrictionDescription& friction) {
  json result{{"law", friction.law}, {"parameters", friction.parameters}, {"gear", friction.gear}};
  // warming, where there is any
  if (friction.thermal) {
    result["thermal"] = ThermalToJson(*friction.thermal);
    result["thermal"]["ambient"] = friction.ambient;
  }
  if (friction.second_thermal) {
    result["thermal"]["second"] = ThermalToJson(*friction.second_thermal);
  }
  // options at 0 change nothing and are left out
  for (const FrictionOption& option : FrictionOptions()) {
    if (friction.*option.value != 0) result[std::string(option.info.name)] = friction.*option.value;
  }
  if (!friction.torque_unit.empty()) result[kTorqueUnitKey] = friction.torque_unit;
  for (const FrictionMap& map : friction.maps) result["maps"].push_back(MapToJson(map));
  return result;
}

FrictionDescription FrictionFromJson(const json& object, const Place& place) {
  // no key but these, and the law in any case
  std::vector<std::string> known{"law",  "parameters", "thermal",
                                 "gear", "maps",       std::string(kTorqueUnitKey)};
  for (const FrictionOption& option : FrictionOptions()) known.emplace_back(option.info.name);
  RefuseUnknownKeys(object, "friction", known, place);
  if (!object.contains("law") || !object["law"].is_string()) {
    Refuse(place, "friction lacks its law; give one of its names as text");
  }

  FrictionDescription friction;

  // the law and its numbers
  friction.law = object["law"].get<std::string>();
  if (object.contains("parameters")) {
    const json& parameters = object["parameters"];
    if (!parameters.is_object()) Refuse(place, "friction's parameters must be an object");
    for (const auto& [name, value] : parameters.items()) {
      friction.parameters[name] = NumberMember(parameters, name, place);
    }
  }
  if (object.contains("thermal")) ReadThermal(object["thermal"], friction, place);
  // what stands beside the law
  if (object.contains(kTorqueUnitKey)) {
    if (object[kTorqueUnitKey] != "A")
      Refuse(place, "friction's torque_unit must be \"A\", or absent");
    friction.torque_unit = "A";
  }
  if (object.contains("gear")) friction.gear = NumberMember(object, "gear", place);
  for (const FrictionOption& option : FrictionOptions()) {
    const std::string name(option.info.name);
    if (object.contains(name)) friction.*option.value = NumberMember(object, name, place);
  }
  if (object.contains("maps")) {
    if (!object["maps"].is_array()) Refuse(place, "friction's maps must be a list");
    for (const json& map : object["maps"]) friction.maps.push_back(MapFromJson(map, place));
  }
  // what was left out, then all of it together
  FillDefaults(friction);
  CheckFriction(friction, place);
  return friction;
}

void RefuseAmperes(const FrictionDescription& friction, const Place& place) {
  if (friction.torque_unit.empty()) return;
  Refuse(place,
         "its friction is in {}, and a simulator needs torque: identify again with "
         "--torque-constant, the torque of the joint for each ampere",
         friction.torque_unit);
}

FrictionDescription ReadFrictionFile(const std::string& path) {
  const json object = ReadJsonFile(path);
  // an estimate holds its friction under that name; else the file is one
  FrictionDescription friction =
      FrictionFromJson(object.contains("friction") ? object["friction"] : object, {path});
  RefuseAmperes(friction, {path});
  return friction;
}

}  // namespace warmjoint::inline models
