#include "tools/export/code_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace warmjoint {

std::string CodeName(const std::string& joint) {
  std::string name;
  for (const char c : joint) {
    name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  }
  if (name.empty()) name = "joint";
  if (std::isdigit(static_cast<unsigned char>(name[0])) != 0) name.insert(0, "joint_");
  return name + "_friction";
}

std::string Literal(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".n") != std::string::npos) return text;
  // why: without a point YAML takes 1e-05 for a text and 5 for an integer
  return text.insert(std::min(text.find('e'), text.size()), ".0");
}

std::vector<CodeLine> AllCodeLines(const SeenFriction& seen, const wj_friction& f) {
  const auto in = [&](const JointUnit& unit) { return unit.For(seen.kind); };
  const std::string_view torque = in(kTorqueUnit);
  // one level to both sides is one parameter
  const bool one_level = seen.friction.parameters.contains("coulomb");
  const std::string level = one_level ? "coulomb" : "";
  return {
      {"viscous", f.viscous, in(kViscousUnit)},
      {"coulomb_positive", f.coulomb_positive, torque, level},
      {"coulomb_negative", f.coulomb_negative, torque, level},
      {"static_rise", f.static_rise, torque},
      {"stribeck_velocity", f.stribeck_velocity, in(kVelocityUnit)},
      {"stribeck_exponent", f.stribeck_exponent, ""},
      {"thermal_gain", f.thermal_gain, in(kThermalGainUnit)},
      {"thermal_time_constant", f.thermal_time_constant, "s"},
      {"second_thermal_gain", f.second_thermal_gain, in(kThermalGainUnit)},
      {"second_thermal_time_constant", f.second_thermal_time_constant, "s"},
      {"level_per_temperature", f.level_per_temperature, in(kLevelPerTemperatureUnit)},
      {"viscous_per_energy", f.viscous_per_energy, in(kTimePerPositionUnit)},
      {"load_gain", f.load_gain, ""},
      {"gear", f.gear, ""},
      {"level_std", f.level_std, torque},
      {"heat_std", f.heat_std, torque},
      {"noise", f.noise, torque},
      {"noise_time", f.noise_time, "s"},
  };
}

std::vector<CodeLine> CodeLinesOf(const SeenFriction& seen, const wj_friction& numbers) {
  std::vector<CodeLine> lines = AllCodeLines(seen, numbers);
  std::erase_if(lines, [](const CodeLine& line) { return line.value == 0; });
  return lines;
}

std::string SaidOf(const CodeLine& line, const SeenFriction& seen) {
  const auto found = seen.intervals.find(line.parameter.empty() ? line.member : line.parameter);
  if (found == seen.intervals.end()) return std::string(line.unit);
  const auto& [lower, upper] = found->second;
  return fmt::format("{:.6g} .. {:.6g} {}", lower, upper, line.unit);
}

std::string CommentOf(const CodeLine& line, const SeenFriction& seen, std::string_view begin) {
  const std::string said = SaidOf(line, seen);
  return said.empty() ? "" : fmt::format("  {} {}", begin, said);
}

std::string LeftOutOf(const Friction& friction) {
  const bool bends = FindLaw(friction.law)->pre_sliding == PreSliding::bristle;
  return bends ? "; left out: the bristle, which bends before it slides" : "";
}

}  // namespace warmjoint
