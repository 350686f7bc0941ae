// Files that let the program simulate Table I of the paper.
#pragma once

#include <sstream>
#include <string>

namespace warmjoint {

/// The scenario for so many s, as YAML. indent: what each line begins with.
inline std::string TableOneYaml(int duration, const std::string& indent = "") {
  std::istringstream lines(R"(plant: ideal
friction:
  law: viscous_coulomb
  parameters: {viscous: 5, coulomb: 15}
  thermal: {thermal_gain: -3, thermal_time_constant: 600}
motion: {speeds: {uniform: [0.1, 1]}, hold: 20, order: alternating}
noise: {torque: 0.5}
sampling: {rate: 1}
duration: )" + std::to_string(duration));
  std::string text;
  for (std::string line; std::getline(lines, line);) text += indent + line + "\n";
  return text;
}

/// A suite of half an hour of it, with seed 3. identifiers: lines of a YAML list.
inline std::string TableOneSuite(int realizations, const std::string& identifiers) {
  return "name: little\nquestion: Are runs repeatable?\nrealizations: " +
         std::to_string(realizations) + "\nseed: 3\nscenario:\n" + TableOneYaml(1800, "  ") +
         "identifiers:\n" + identifiers;
}

}  // namespace warmjoint
