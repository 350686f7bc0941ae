#include "scenarios/read_scenario.h"

#include <algorithm>
#include <filesystem>

#include "models/foundation/atomic_file.h"
#include "scenarios/scenario_words.h"
#include "scenarios/write_scenario.h"
#include "scenarios/yaml_distribution.h"
#include "scenarios/yaml_disturbances.h"
#include "scenarios/yaml_friction.h"
#include "scenarios/yaml_motion.h"

namespace warmjoint::inline scenarios {
namespace {

namespace fs = std::filesystem;

/// Overwrites `number` where the map has the entry.
void ReadNumber(const YamlValue& map, std::string_view name, Bound bound, double& number) {
  if (const auto value = map.Find(name)) number = value->Number(bound);
}

/// A path stands relative to the file that names it; a robot of the project has a name alone.
std::string ReadRobot(const YamlValue& value) {
  const std::string robot = value.Text();
  const fs::path beside = fs::path(value.file()).parent_path() / robot;
  return fs::path(robot).has_extension() && fs::exists(beside) ? beside.string() : robot;
}

void ReadInitialEnergy(const YamlValue& value, Scenario& scenario) {
  // a number, or a distribution that each realization draws from
  const Distribution energy = ReadDistribution(value, Bound::any);
  scenario.initial_energy = energy.a;
  if (energy.kind != Distribution::Kind::fixed) scenario.draws.numbers["initial_energy"] = energy;
}

Controller ReadController(const YamlValue& value) {
  value.RequireKeys({"bandwidth", "acceleration"});
  Controller controller;
  ReadNumber(value, "bandwidth", Bound::not_negative, controller.bandwidth);
  ReadNumber(value, "acceleration", Bound::not_negative, controller.acceleration);
  return controller;
}

Noise ReadNoise(const YamlValue& value) {
  value.RequireKeys({"torque", "velocity", "position"});
  Noise noise;
  ReadNumber(value, "torque", Bound::not_negative, noise.torque);
  ReadNumber(value, "velocity", Bound::not_negative, noise.velocity);
  ReadNumber(value, "position", Bound::not_negative, noise.position);
  return noise;
}

Sampling ReadSampling(const YamlValue& value) {
  value.RequireKeys({"rate", "sensor_rate", "cutoff"});
  // sensors are read as often as is stored, or more, unless the file says otherwise
  Sampling sampling;
  ReadNumber(value, "rate", Bound::positive, sampling.rate);
  sampling.sensor_rate = std::max(sampling.sensor_rate, sampling.rate);
  ReadNumber(value, "sensor_rate", Bound::positive, sampling.sensor_rate);
  ReadNumber(value, "cutoff", Bound::not_negative, sampling.cutoff);

  // a log holds no more samples than sensors give, and a filter works below half their rate
  if (sampling.rate > sampling.sensor_rate) {
    Refuse(value.place(),
           "{}.rate is {} Hz; it must be at most the {} Hz of sensor_rate: sensors cannot be "
           "stored more often than they are read",
           value.key(), sampling.rate, sampling.sensor_rate);
  }
  if (sampling.cutoff >= sampling.sensor_rate / 2) {
    Refuse(value.place(),
           "{}.cutoff is {} Hz; it must be below half the sensor_rate of {} Hz; 0 filters nothing",
           value.key(), sampling.cutoff, sampling.sensor_rate);
  }
  return sampling;
}

void CheckSampleCount(const YamlValue& value, const Scenario& scenario) {
  constexpr double fewest = 3, most = 1e8;
  const double samples = scenario.duration * scenario.sampling.rate;
  if (samples >= fewest && samples <= most) return;
  Refuse(value.place(),
         "{} s at a sampling.rate of {} Hz make {:g} samples; a recording has {:g} to {:g}",
         scenario.duration, scenario.sampling.rate, samples, fewest, most);
}

/// Steps of the engine that a simulation may take: some hours.
void CheckStepCount(const YamlValue& value, const Scenario& scenario) {
  constexpr double most = 1e10;
  const double steps = scenario.duration / scenario.timestep;
  if (scenario.plant != PlantKind::mujoco || steps <= most) return;
  Refuse(value.place(),
         "{} s at a timestep of {} s make {:g} steps of the engine; {:g} at most: lengthen "
         "timestep or shorten duration",
         scenario.duration, scenario.timestep, steps, most);
}

void ReadRobotJoint(const YamlValue& value, Scenario& scenario) {
  // the ideal plant can do without both
  const bool needed = scenario.plant == PlantKind::mujoco;
  const auto robot = value.Find("robot");
  const auto joint = value.Find("joint");
  if (needed && !robot) value.Require("robot", "the mujoco plant needs a robot (`list robots`)");
  if (needed && !joint) value.Require("joint", "the mujoco plant needs the name of a joint");
  if (robot) scenario.robot = ReadRobot(*robot);
  if (joint) scenario.joint = joint->Text();
}

}  // namespace

Scenario ReadScenarioValue(const YamlValue& value, const std::string& name) {
  value.RequireKeys({"name", "plant", "robot", "joint", "joint_kind", "friction", "initial_energy",
                     "motion", "controller", "noise", "disturbances", "sampling", "timestep",
                     "duration", "seed"});
  Scenario scenario;
  scenario.name = name;
  if (const auto given = value.Find("name")) scenario.name = given->Text();

  // what moves
  if (const auto plant = value.Find("plant")) scenario.plant = ReadChoice(*plant, PlantKinds());
  if (const auto kind = value.Find("joint_kind")) {
    scenario.joint_kind = ReadChoice(*kind, JointKinds());
  }
  ReadRobotJoint(value, scenario);
  scenario.friction = ReadFriction(
      value.Require("friction", "give the true law and its parameters"), scenario.draws);
  if (const auto energy = value.Find("initial_energy")) ReadInitialEnergy(*energy, scenario);

  // how it moves and is logged
  scenario.motion = ReadMotion(value.Require("motion", "give speeds, and hold or travel"));
  if (const auto part = value.Find("controller")) scenario.controller = ReadController(*part);
  if (const auto part = value.Find("noise")) scenario.noise = ReadNoise(*part);
  if (const auto part = value.Find("disturbances")) {
    scenario.disturbances = ReadDisturbances(*part);
    // some disturbances are known to the ideal plant alone
    const std::string_view ideal_only = IdealOnly(scenario.disturbances);
    if (scenario.plant != PlantKind::ideal && !ideal_only.empty()) {
      Refuse(part->place(), "{}.{} is known to the ideal plant alone; take it out, or use it",
             part->key(), ideal_only);
    }
    // a temperature that swings must act on something
    if (scenario.disturbances.ambient_temperature.amplitude != 0 &&
        scenario.friction.level_per_temperature == 0) {
      Refuse(part->place(),
             "{}.ambient_temperature changes nothing while friction.level_per_temperature is 0",
             part->key());
    }
  }
  if (const auto part = value.Find("sampling")) scenario.sampling = ReadSampling(*part);
  ReadNumber(value, "timestep", Bound::positive, scenario.timestep);

  // how long, within what memory and patience allow
  const YamlValue duration = value.Require("duration", "give the seconds to simulate");
  scenario.duration = duration.Number(Bound::positive);
  CheckSampleCount(duration, scenario);
  CheckStepCount(duration, scenario);
  if (const auto seed = value.Find("seed")) {
    scenario.seed = seed->Seed();
  }
  return scenario;
}

Scenario ReadScenario(const std::string& path, const Settings& settings) {
  const YamlValue document =
      YamlValue::Parse(ReadWholeFile(path, kLargestDocument), path, settings);
  return ReadScenarioValue(document, fs::path(path).stem().string());
}

Scenario WithSettings(const Scenario& scenario, const Settings& settings) {
  const std::string yaml = ScenarioToYaml(scenario);
  return ReadScenarioValue(YamlValue::Parse(yaml, scenario.name, settings), scenario.name);
}

}  // namespace warmjoint::inline scenarios
