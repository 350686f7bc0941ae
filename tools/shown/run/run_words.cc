// What a suite simulates, in words.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "models/foundation/serialize.h"
#include "tools/shown/run/run_data.h"

namespace warmjoint::shown {
namespace {

std::string PlantOf(const Scenario& scenario) {
  if (scenario.plant == PlantKind::ideal) {
    return "Each realization is a joint that follows the equations of friction and warming "
           "exactly, without a robot around it.";
  }
  return fmt::format(
      "Each realization is the joint {} of the robot {} in MuJoCo, driven by a controller and "
      "braked by the friction of warmjoint's plugin.",
      scenario.joint, scenario.robot);
}

std::string FrictionOf(const Scenario& scenario) {
  const Friction& friction = scenario.friction;
  std::string words = fmt::format("Its friction follows the law {}", friction.law);
  if (!friction.maps.empty()) words += ", and depends on position";
  if (friction.thermal) {
    words += fmt::format(
        "; it {} as the joint warms by its own losses, with a time constant of {:g} s",
        friction.thermal->gain < 0 ? "falls" : "grows", friction.thermal->time_constant);
  }
  return words + ".";
}

std::string MotionOf(const Scenario& scenario) {
  const bool turns = scenario.joint_kind == JointKind::rotary;
  const Motion& motion = scenario.motion;
  // what kind of motion the scenario asks for
  std::string words = "It moves forwards and backwards at constant speeds";
  if (!motion.corners.empty()) words = "It repeats a recorded motion";
  if (motion.fourier) words = "It moves by Fourier excitation, which never holds a speed";
  if (motion.moves) words = "It moves from place to place, as in pick and place";
  if (!motion.phases.empty()) words = "It works in phases of motion and rest";
  // its speeds, and how long it holds each
  if (!motion.speeds.list.empty()) {
    words +=
        fmt::format(" of {:g} {}", fmt::join(motion.speeds.list, ", "), turns ? "rad/s" : "m/s");
  }
  if (motion.hold > 0) words += fmt::format(", each held for {:g} s", motion.hold);
  return words + ".";
}

std::string LogOf(const Scenario& scenario) {
  return fmt::format(
      "The log is sampled at {:g} Hz for {:g} s. An identifier gets time, position, velocity and "
      "torque, and neither the truth nor a temperature.",
      scenario.sampling.rate, scenario.duration);
}

std::string NoiseOf(const Scenario& scenario) {
  std::string words;
  if (scenario.noise.torque > 0) {
    words = fmt::format("The torque has noise of {:g} {}.", scenario.noise.torque,
                        kTorqueUnit.For(scenario.joint_kind));
  }
  // what is at its default is not written
  if (!WriteFields(scenario.disturbances).empty()) {
    words += fmt::format("{}Disturbances that no identifier is told of stand in suite.yaml below.",
                         words.empty() ? "" : " ");
  }
  return words;
}

std::string LadderOf(const Ladder& ladder) {
  std::vector<std::string> names;
  for (const Variant& variant : ladder.variants) names.push_back(variant.name);
  const std::string what = ladder.variable.empty() ? "what is changed" : ladder.variable;
  return fmt::format("There are {} variants, by {}: {}.", names.size(), what,
                     fmt::join(names, ", "));
}

}  // namespace

std::vector<std::string> WhatWasSimulated(const Suite& suite) {
  const Scenario& scenario = suite.scenario;
  std::vector<std::string> sentences{PlantOf(scenario), FrictionOf(scenario), MotionOf(scenario),
                                     LogOf(scenario)};
  const std::string noise = NoiseOf(scenario);
  if (!noise.empty()) sentences.push_back(noise);
  if (suite.ladder) sentences.push_back(LadderOf(*suite.ladder));
  return sentences;
}

}  // namespace warmjoint::shown
