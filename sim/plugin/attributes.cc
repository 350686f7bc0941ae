#include "sim/plugin/attributes.h"

#include <algorithm>

#include "models/foundation/parse_number.h"
#include "models/friction/law.h"

namespace warmjoint {
namespace {

std::string BoundOf(const ParameterInfo& info) {
  if (info.lower == -kInfinity) return "any";
  if (info.lower == kSmallestPositive) return "> 0";
  if (info.upper != kInfinity) return fmt::format("{} to {}", info.lower, info.upper);
  return fmt::format(">= {}", info.lower);
}

void AddParameter(const ParameterInfo& info, std::vector<PluginAttribute>& attributes) {
  const auto same_name = [&](const PluginAttribute& known) { return known.name == info.name; };
  if (std::any_of(attributes.begin(), attributes.end(), same_name)) return;
  attributes.push_back({std::string(info.name), std::string(info.unit.rotary), BoundOf(info),
                        std::string(info.meaning)});
}

std::vector<PluginAttribute> MakeAttributes() {
  std::vector<PluginAttribute> attributes{
      {"law", "", fmt::format("{}", fmt::join(LawNames(), ", ")), "the nominal law"},
      {"file", "", "path", "friction file instead of all the other attributes"},
      {"gear", "rad/rad", "not 0", "motor turns for each joint turn; 1 where not given"},
  };
  for (const Law& law : Laws()) {
    for (const ParameterInfo& info : law.parameters) AddParameter(info, attributes);
  }
  for (const ParameterInfo& info : Thermal::parameters) AddParameter(info, attributes);
  return attributes;
}

double Number(const std::string& name, const std::string& text, const Place& place) {
  const std::optional<double> value = ParseNumber(text);
  if (!value) Refuse(place, "{} is '{}'; it must be a number", name, text);
  return *value;
}

FrictionDescription ReadFile(const std::string& path, const AttributeReader& read,
                             const Place& place) {
  for (const PluginAttribute& attribute : PluginAttributes()) {
    if (attribute.name == "file" || read(attribute.name).empty()) continue;
    Refuse(place, "{} is '{}' beside file '{}'; give the file or the other attributes",
           attribute.name, read(attribute.name), path);
  }
  try {
    return ReadFrictionFile(path);
  } catch (const BadInput& refusal) {
    Refuse(place, "file: {}", refusal.what());
  }
}

std::optional<Thermal> ReadThermal(const AttributeReader& read, const Place& place) {
  const std::string gain = read("thermal_gain");
  const std::string time_constant = read("thermal_time_constant");
  if (gain.empty() && time_constant.empty()) return std::nullopt;
  if (gain.empty() || time_constant.empty()) {
    Refuse(place, "thermal_gain is '{}' and thermal_time_constant '{}'; give both or neither", gain,
           time_constant);
  }
  return Thermal{Number("thermal_gain", gain, place),
                 Number("thermal_time_constant", time_constant, place)};
}

}  // namespace

const std::vector<PluginAttribute>& PluginAttributes() {
  static const std::vector<PluginAttribute> attributes = MakeAttributes();
  return attributes;
}

FrictionDescription ReadAttributes(const AttributeReader& read, const Place& place) {
  const std::string path = read("file");
  if (!path.empty()) return ReadFile(path, read, place);

  FrictionDescription friction;
  if (read("law").empty()) {
    Refuse(place, "law is missing; give one of {}", fmt::join(LawNames(), ", "));
  }
  friction.law = read("law");

  // every parameter that is given, whichever law it belongs to; the check finds those too many
  for (const Law& law : Laws()) {
    for (const ParameterInfo& info : law.parameters) {
      const std::string name(info.name);
      const std::string text = read(name);
      if (!text.empty()) friction.parameters[name] = Number(name, text, place);
    }
  }
  friction.thermal = ReadThermal(read, place);
  if (!read("gear").empty()) friction.gear = Number("gear", read("gear"), place);
  FillDefaults(friction);
  CheckFriction(friction, place);
  return friction;
}

}  // namespace warmjoint
