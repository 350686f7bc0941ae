// Everything that one simulated run depends on, in one struct with a seed.
#pragma once

#include <warmjoint/friction.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "scenarios/disturbances.h"
#include "scenarios/motion.h"
#include "scenarios/truth_draws.h"

namespace warmjoint {

/// ideal: Sec. III of the paper exactly, no engine. mujoco: the robot, a controller and the plugin.
enum class PlantKind { ideal, mujoco };

inline std::span<const Word<PlantKind>> WordsOf(PlantKind) {
  static constexpr std::array words{Word{"ideal", PlantKind::ideal},
                                    Word{"mujoco", PlantKind::mujoco}};
  return words;
}

/// Velocity controller of the mujoco plant: torque = feedforward + kp e + ki integral(e).
struct Controller {
  /// rad/s, of the closed velocity loop; gains follow from the joint's inertia. 0: chosen by the
  /// mujoco plant for inertia, friction, gravity and motion
  double bandwidth = 0;
  double acceleration =
      0;  // rad/s^2 or m/s^2 of the reference between segments; 0: chosen by the mujoco plant, and
          // jumps in the ideal one

  template <class A>
  void Serialize(A* a) {
    a->Field("bandwidth", &bandwidth, {.unit = "rad/s", .bounds = {.at_least = 0}});
    a->Field("acceleration", &acceleration, {.unit = "rad/s^2", .bounds = {.at_least = 0}});
  }

  bool operator==(const Controller&) const = default;
};

/// How the log is made: sensors, filter, storage.
struct Sampling {
  double rate = 20;          // Hz of the stored recording, at most sensor_rate
  double sensor_rate = 250;  // Hz at which sensors are read and filtered
  double cutoff = 0;         // Hz of the low-pass on the sensor samples; 0: none

  template <class A>
  void Serialize(A* a) {
    a->Field("rate", &rate, {.unit = "Hz", .bounds = {.above = 0}});
    // sensors are read as often as is stored, or more, unless the file says otherwise
    sensor_rate = std::max(sensor_rate, rate);
    a->Field("sensor_rate", &sensor_rate, {.unit = "Hz", .bounds = {.above = 0}});
    a->Field("cutoff", &cutoff, {.unit = "Hz", .bounds = {.at_least = 0}});
    a->Check(rate <= sensor_rate, "rate",
             "at most sensor_rate: no sample is stored that was not read");
    a->Check(cutoff < sensor_rate / 2, "cutoff",
             "below half the sensor_rate, or 0, which filters nothing");
  }

  bool operator==(const Sampling&) const = default;
};

/// Standard deviations of white noise on each sensor sample.
struct Noise {
  double torque = 0;    // N.m or N
  double velocity = 0;  // rad/s or m/s
  double position = 0;  // rad or m

  template <class A>
  void Serialize(A* a) {
    a->Field("torque", &torque, {.unit = "N.m", .bounds = {.at_least = 0}});
    a->Field("velocity", &velocity, {.unit = "rad/s", .bounds = {.at_least = 0}});
    a->Field("position", &position, {.unit = "rad", .bounds = {.at_least = 0}});
  }

  bool operator==(const Noise&) const = default;
};

struct Scenario {
  std::string name;
  PlantKind plant = PlantKind::ideal;
  JointKind joint_kind = JointKind::rotary;
  std::string robot;  // name in models/robots or path of an MJCF or URDF file; mujoco plant only
  std::string joint;  // name of the joint; mujoco plant only
  Friction friction;
  double initial_energy = 0;  // E(0), N.m or N
  TruthDraws draws;           // what is drawn of the truth above for each realization
  Motion motion;
  Controller controller;
  Noise noise;
  Disturbances disturbances;
  Sampling sampling;
  double timestep = 0.001;  // s, of the engine; mujoco plant only
  double duration = 0;      // s
  std::uint64_t seed = 0;

  template <class A>
  void Serialize(A* a) {
    // what moves
    constexpr auto left_out = AtDefault::left_out;
    a->Field("name", &name);
    a->Field("plant", &plant);
    const bool engine = plant == PlantKind::mujoco;
    a->Field("robot", &robot, {.at_default = left_out});
    a->Require(engine, "robot", "the mujoco plant needs a robot (`list robots`)");
    a->Field("joint", &joint, {.at_default = left_out});
    a->Require(engine, "joint", "the mujoco plant needs the name of a joint");
    a->Field("joint_kind", &joint_kind);
    DrawnTruth truth{friction, initial_energy, draws};
    truth.Serialize(a);
    friction = truth.friction;
    initial_energy = truth.initial_energy;
    draws = truth.draws;

    // how it moves and is logged
    a->Field("motion", &motion, {.needed = "give speeds, and hold or travel"});
    a->Field("controller", &controller);
    a->Field("noise", &noise);
    a->Field("disturbances", &disturbances, {.at_default = left_out});
    a->Field("sampling", &sampling);
    a->Field("timestep", &timestep, {.unit = "s", .bounds = {.above = 0}});
    a->Field("duration", &duration,
             {.unit = "s", .bounds = {.above = 0}, .needed = "give the seconds to simulate"});
    a->Field("seed", &seed);
  }
};

}  // namespace warmjoint
