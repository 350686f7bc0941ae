#include "tools/actions/initial_energy.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "models/foundation/excerpt.h"
#include "models/foundation/json_members.h"
#include "models/foundation/parse_number.h"
#include "models/foundation/read_json.h"
#include "models/friction/settled_energy.h"

namespace warmjoint::inline tools {
namespace {

constexpr std::string_view kSettled = "settled:";

/// The heat at the end of a recording: {energy, second_energy} of state_end.
std::vector<double> EndEnergy(const FrictionDescription& friction, const std::string& file) {
  if (!friction.thermal) return {};
  const nlohmann::json object = ReadJsonFile(file);
  const Place place{file};
  // only estimates of a warming joint tell the heat at the end
  if (!object.is_object() || !object.contains("state_end") || !object["state_end"].is_object()) {
    Refuse(place,
           "has no state_end, the heat at the end of its recording; identify again, or give "
           "--initial cold or settled:SPEED");
  }
  const nlohmann::json& end = object["state_end"];
  std::vector<double> energies;
  // heat of each stage
  const auto add = [&](const char* key) {
    if (!end.contains(key)) Refuse(place, "state_end has no {}; identify again", key);
    // a number, or an object of its value, standard error and interval
    const nlohmann::json& given = end[key];
    const bool whole = given.is_object() && given.contains("value");
    const nlohmann::json& value = whole ? given["value"] : given;
    energies.push_back(NumberFrom(value, fmt::format("state_end.{}", key), place));
  };
  add("energy");
  if (friction.second_thermal) add("second_energy");
  return energies;
}

std::vector<double> Settled(const std::string& text, const FrictionDescription& friction,
                            const std::string& file) {
  // the heat that the joint settles at when it moves at this speed for ever
  const auto speed = ParseNumber(text);
  if (!speed || !std::isfinite(*speed)) {
    Refuse({"--initial"}, "is settled:{}; the speed must be a number, rad/s or m/s, as settled:0.5",
           Excerpt(text));
  }
  // too fast, and the heat grows without end
  const auto energies = SettledEnergy(friction, *speed);
  if (energies) return *energies;
  Refuse({file},
         "its friction never settles at {} rad/s or m/s: thermal_gain times the speed must stay "
         "below 1; give a smaller speed to --initial",
         *speed);
}

}  // namespace

std::vector<double> InitialEnergy(const std::string& initial, const FrictionDescription& friction,
                                  const std::string& file) {
  if (initial == "cold") return {};
  if (initial == "end") return EndEnergy(friction, file);
  if (initial.starts_with(kSettled)) {
    return Settled(initial.substr(kSettled.size()), friction, file);
  }
  Refuse({"--initial"}, "is '{}'; it must be cold, end or settled:SPEED", Excerpt(initial));
}

}  // namespace warmjoint::inline tools
