// Everything that one simulated run depends on, in one struct with a seed.
#pragma once

#include <warmjoint/friction.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scenarios/disturbances.h"
#include "scenarios/motion.h"
#include "scenarios/truth_draws.h"

namespace warmjoint {

/// A `--set key=value` of the command line or of a suite's ladder. key: a dotted path such as
/// noise.torque; value: YAML, where `null` takes the entry out.
struct Setting {
  std::string key;
  std::string value;
};

using Settings = std::vector<Setting>;

/// ideal: Sec. III of the paper exactly, no engine. mujoco: the robot, a controller and the plugin.
enum class PlantKind { ideal, mujoco };

inline std::span<const Word<PlantKind>> WordsOf(PlantKind) {
  static constexpr std::array words{Word{"ideal", PlantKind::ideal},
                                    Word{"mujoco", PlantKind::mujoco}};
  return words;
}

/// Velocity controller of the mujoco plant: torque = feedforward + kp e + ki integral(e), whose gains follow from the joint's inertia.
struct Controller {
  double bandwidth = 0;
  double acceleration = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("bandwidth", &bandwidth,
             WithDefault("rad/s",
                         "of the closed velocity loop of the `mujoco` plant; 0: chosen for "
                         "inertia, friction, gravity and motion",
                         kNotNegative));
    a->Field("acceleration", &acceleration,
             WithDefault("rad/s^2",
                         "of the reference between speeds; 0: chosen by the `mujoco` plant, jumps "
                         "in the ideal one",
                         kNotNegative));
  }
};

/// How the log is made: sensors, filter, storage.
struct Sampling {
  double rate = 20;
  double sensor_rate = 250;
  double cutoff = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("rate", &rate,
             WithDefault("Hz", "samples stored in a second, at most `sensor_rate`", kPositive));
    // sensors are read as often as is stored, or more, unless the file says otherwise
    sensor_rate = std::max(sensor_rate, rate);
    a->Field(
        "sensor_rate", &sensor_rate,
        WithDefault("Hz",
                    "readings of the sensors in a second (`mujoco`), as often as is stored or more",
                    kPositive));
    a->Field("cutoff", &cutoff,
             WithDefault("Hz",
                         "low-pass of 4th order on the readings (`mujoco`), below half of "
                         "`sensor_rate`; 0: none",
                         kNotNegative));
    a->Check(rate <= sensor_rate, "rate",
             "at most sensor_rate: no sample is stored that was not read");
    a->Check(cutoff < sensor_rate / 2, "cutoff",
             "below half the sensor_rate, or 0, which filters nothing");
  }
};

/// Standard deviations of white noise on each sensor sample.
struct Noise {
  double torque = 0;
  double velocity = 0;
  double position = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("torque", &torque,
             WithDefault("N.m", "standard deviation on each reading of the torque", kNotNegative));
    a->Field("velocity", &velocity, WithDefault("rad/s", "the same of the velocity", kNotNegative));
    a->Field("position", &position, WithDefault("rad", "the same of the position", kNotNegative));
  }
};

struct Scenario {
  std::string name;
  PlantKind plant = PlantKind::ideal;
  JointKind joint_kind = JointKind::rotary;
  std::string robot;
  std::string joint;
  Friction friction;
  double initial_energy = 0;  // N.m or N
  TruthDraws draws;           // what is drawn of the truth above for each realization
  Motion motion;
  Controller controller;
  Noise noise;
  Disturbances disturbances;
  Sampling sampling;
  double timestep = 0.001;
  double duration = 0;
  std::uint64_t seed = 0;

  template <class A>
  void Serialize(A* a) {
    // what moves
    a->Field("name", &name, {.meaning = "for tables and titles; the file's name where not given"});
    a->Field(
        "plant", &plant,
        {.meaning = "`ideal`: the formulas alone; `mujoco`: a robot, a controller, the plugin"});
    const bool engine = plant == PlantKind::mujoco;
    a->Field("robot", &robot,
             LeftOut("needed by `mujoco`: a robot of `warmjoint list robots`, or an MJCF or "
                     "URDF file relative to the scenario"));
    a->Require(engine, "robot", "the mujoco plant needs a robot (`list robots`)");
    a->Field("joint", &joint, LeftOut("needed by `mujoco`: the robot's joint that moves"));
    a->Require(engine, "joint", "the mujoco plant needs the name of a joint");
    a->Field("joint_kind", &joint_kind,
             {.meaning = "of the ideal plant: `rotary` (rad, N.m) or `linear` (m, N)"});
    SerializeTruth(a);

    // how it moves and is logged
    a->Field("motion", &motion,
             {.meaning = "the plan of the velocity", .needed = "give speeds, and hold or travel"});
    a->Field("controller", &controller, {.meaning = "drives the joint of the `mujoco` plant"});
    a->Field("noise", &noise, {.meaning = "white, of the sensors"});
    a->Field("disturbances", &disturbances, LeftOut("what else acts on the joint or on its log"));
    a->Field("sampling", &sampling, {.meaning = "how the log is made"});
    a->Field("timestep", &timestep, WithDefault("s", "of the engine (`mujoco`)", kPositive));
    a->Field("duration", &duration,
             Needed("s", "length of the recording", kPositive, "give the seconds to simulate"));
    a->Field("seed", &seed, {.meaning = "of all random numbers; a suite gives its own"});
  }
  /// Its truth, at the middles of what is drawn.
  template <class A>
  void SerializeTruth(A* a) {
    const auto drawn = draws.numbers.find(kInitialEnergy);
    Distribution energy =
        drawn == draws.numbers.end() ? Distribution{.a = initial_energy} : drawn->second;
    draws.numbers.erase(kInitialEnergy);
    DrawnFriction truth{friction, draws};
    a->Field("friction", &truth,
             {.meaning = "the true friction as in a friction file, any number a distribution; a "
                         "friction file's path; or {estimate: FILE}",
              .needed = "give the true law and its parameters"});
    a->Field(kInitialEnergy, &energy, {.unit = "N.m", .meaning = "E(0), the heat at the start"});
    friction = truth.friction;
    draws = truth.draws;
    initial_energy = energy.a;
    if (energy.kind != Distribution::Kind::fixed) draws.numbers[kInitialEnergy] = energy;
  }
};

/// The scenario with every drawn truth replaced by this realization's number, from
/// (scenario.seed, realization, Stream::truth). A scenario without draws comes back as it is.
Scenario Realize(const Scenario& scenario, std::uint64_t realization);

}  // namespace warmjoint
