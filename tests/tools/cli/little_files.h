// Small recordings, and files that let the program simulate Table I of the paper.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <sstream>
#include <string>

#include "models/foundation/atomic_file.h"
#include "models/friction/sign.h"

namespace warmjoint {

/// Four speeds in both directions, 30 s each, rad/s; i: s.
inline double SeveralSpeeds(int i) { return (i / 30 % 2 ? -1 : 1) * 0.2 * (1 + i / 60 % 4); }

/// Writes `samples` rows of time (every second), position, velocity and torque of a joint that
/// turns with velocity(i) rad/s under 5 v + 15 sign(v) N.m and a little ripple in place of noise.
/// level(i): what joins the level at each sample, N.m.
inline void WriteRecordingFile(
    const std::filesystem::path& path, int samples,
    const std::function<double(int)>& velocity = SeveralSpeeds,
    const std::function<double(int)>& level = [](int) { return 0.0; }) {
  std::string text = "time,position,velocity,torque\n";
  double position = 0;
  for (int i = 0; i < samples; ++i) {
    const double v = velocity(i);
    const double torque = 5 * v + (15 + level(i)) * Sign(v) + 0.2 * std::sin(12.9898 * i);
    text += fmt::format("{},{},{},{}\n", i, position, v, torque);
    position += v;
  }
  WriteWholeFile(path, text);
}

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
