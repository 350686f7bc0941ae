#include "tools/figures/run/run_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "identification/identifiers/identifier_list.h"
#include "tools/figures/number_text.h"

namespace warmjoint::figures {
namespace {

std::string PlantOf(const Scenario& scenario) {
  if (scenario.plant == PlantKind::ideal) {
    return "Each realization is a joint that follows the equations of friction and warming "
           "exactly, "
           "without a robot around it.";
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
  if (!motion.speed_list.empty()) {
    std::vector<std::string> speeds;
    for (const double speed : motion.speed_list) speeds.push_back(fmt::format("{:g}", speed));
    words += fmt::format(" of {} {}", fmt::join(speeds, ", "), turns ? "rad/s" : "m/s");
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
                        UnitText(kTorqueUnit.For(scenario.joint_kind)));
  }
  if (scenario.disturbances != Disturbances{}) {
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

std::string WhatItIs(const SuiteIdentifier& identifier) {
  // a command from outside is its own description
  if (identifier.name == kExternal) {
    const auto command = identifier.options.find("command");
    return "a command from outside" +
           (command == identifier.options.end() ? "" : ": " + command->second);
  }
  // an identifier of the list has a summary, and options that the suite gives
  std::string words = FindIdentifier(identifier.name).summary;
  std::vector<std::string> options;
  for (const auto& [key, value] : identifier.options) options.push_back(key + "=" + value);
  if (!options.empty()) words += fmt::format(" (with {})", fmt::join(options, ", "));
  return words;
}

const std::vector<std::pair<std::string, std::string>>& RunTerms() {
  static const std::vector<std::pair<std::string, std::string>> terms{
      {"realization",
       "One simulated log: its noise, and where the suite says so its truth and motion, are drawn "
       "anew."},
      {"identifier", "A method that finds the friction's parameters in a log."},
      {"NPE",
       "Normalised parameter error: the length of the vector of relative errors of all parameters, "
       "against the known truth. 1 % is one part in a hundred. The discrete NPE is that of the two "
       "parameters of the sampled warming, as in the paper."},
      {"Cramér-Rao bound",
       "The error that no unbiased method can undercut on such logs, by their noise and length. An "
       "rms NPE of 1.0 times the bound cannot be bettered."},
      {"NPE above best",
       "How much larger an identifier's NPE is than the best one's on the same realization, median "
       "with a 95 % interval; where it holds 0 the two are tied."},
      {"RMSE, MAE", "Root mean square error and mean absolute error of the fitted torque."},
      {"Fit", "1 − norm of the residual over norm of the torque's variation, in per cent."},
      {"FPE", "Final prediction error: the mean square error, raised for each parameter fitted."},
      {"interval holds the truth",
       "Share of 95 % intervals that contain the true value; 95 % is right."},
      {"failure",
       "A realization for which the identifier gave no numbers, or called its numbers void."},
  };
  return terms;
}

}  // namespace warmjoint::figures
