// Everything that one simulated run depends on, in one struct with a seed.
#pragma once

#include <cstdint>
#include <string>

#include "models/friction/friction_description.h"
#include "scenarios/disturbances.h"
#include "scenarios/motion.h"
#include "scenarios/truth_draws.h"

namespace warmjoint::inline scenarios {

/// ideal: Sec. III of the paper exactly, no engine. mujoco: the robot, a controller and the plugin.
enum class PlantKind { ideal, mujoco };

/// Velocity controller of the mujoco plant: torque = feedforward + kp e + ki integral(e).
struct Controller {
  /// rad/s, of the closed velocity loop; gains follow from the joint's inertia. 0: chosen by the
  /// mujoco plant for inertia, friction, gravity and motion
  double bandwidth = 0;
  double acceleration =
      0;  // rad/s^2 or m/s^2 of the reference between segments; 0: chosen by the mujoco plant, and
          // jumps in the ideal one

  bool operator==(const Controller&) const = default;
};

/// How the log is made: sensors, filter, storage.
struct Sampling {
  double rate = 20;          // Hz of the stored recording, at most sensor_rate
  double sensor_rate = 250;  // Hz at which sensors are read and filtered
  double cutoff = 0;         // Hz of the low-pass on the sensor samples; 0: none

  bool operator==(const Sampling&) const = default;
};

/// Standard deviations of white noise on each sensor sample.
struct Noise {
  double torque = 0;    // N.m or N
  double velocity = 0;  // rad/s or m/s
  double position = 0;  // rad or m

  bool operator==(const Noise&) const = default;
};

struct Scenario {
  std::string name;
  PlantKind plant = PlantKind::ideal;
  JointKind joint_kind = JointKind::rotary;
  std::string robot;  // name in models/robots or path of an MJCF or URDF file; mujoco plant only
  std::string joint;  // name of the joint; mujoco plant only
  FrictionDescription friction;
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
};

}  // namespace warmjoint::inline scenarios
