// What acts on a joint or on its log beside friction and white noise. All zero: nothing.
#pragma once

#include <warmjoint/field.h>
#include <warmjoint/friction.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <optional>

#include "scenarios/sensor_faults.h"

namespace warmjoint {

struct Outliers {
  double fraction = 0;
  double size = 0;
  double one_sided = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("fraction", &fraction,
             Needed("", "share of the samples", {.at_least = 0, .below = 1}));
    a->Field("size", &size,
             Needed("N.m", "standard deviation of what is added to them", kNotNegative));
    a->Field("one_sided", &one_sided,
             WithDefault("", "1: what is added is never negative", {.at_least = 0, .at_most = 1}));
  }
};

/// n[i+1] = a n[i] + sqrt(1 - a^2) deviation w[i],
/// a = exp(-h / correlation_time), from its stationary distribution on.
struct ColouredNoise {
  double deviation = 0;
  double correlation_time = 1;

  template <class A>
  void Serialize(A* a) {
    a->Field("deviation", &deviation, Needed("N.m", "standard deviation", kNotNegative));
    a->Field("correlation_time", &correlation_time,
             Needed("s", "of its autocorrelation", kPositive));
  }
};

/// Its deviation is of_torque |f| + of_speed |v|, with the friction f and the speed v.
struct UnevenNoise {
  double of_torque = 0;
  double of_speed = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("of_torque", &of_torque,
             WithDefault("", "its deviation as a share of the friction's size", kNotNegative));
    a->Field("of_speed", &of_speed,
             WithDefault("N.m.s/rad", "its deviation for each unit of speed", kNotNegative));
  }
};

/// amplitude sin(2 pi t / period + phase), the phase drawn for each realization.
struct PeriodicTorque {
  double amplitude = 0;
  double period = 1;

  template <class A>
  void Serialize(A* a) {
    a->Field("amplitude", &amplitude, Needed("N.m", "size of the sine"));
    a->Field("period", &period, Needed("s", "of the sine; its phase is drawn", kPositive));
  }
};

/// G = sine sin p + cosine cos p of Eq. (6). Ideal plant only: a robot has its own.
struct Gravity {
  double sine = 0;
  double cosine = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("sine", &sine, WithDefault("N.m", "share of sin p"));
    a->Field("cosine", &cosine, WithDefault("N.m", "share of cos p"));
  }
};

/// The level of friction follows the ambient temperature: amplitude sin(2 pi t / period) joins E,
/// the limit that the paper states. Ideal plant only.
struct AmbientDrift {
  double amplitude = 0;
  double period = 1;

  /// What joins E at each of some times, s. [N] N.m or N
  Eigen::VectorXd LevelAlong(const Eigen::VectorXd& time) const {
    return amplitude * (2 * std::numbers::pi / period * time.array()).sin();
  }

  template <class A>
  void Serialize(A* a) {
    a->Field("amplitude", &amplitude, Needed("N.m", "size of the sine"));
    a->Field("period", &period, Needed("s", "of the sine", kPositive));
  }
};

/// The ambient temperature swings about the one at which the law's parameters hold: a rise of
/// amplitude sin(2 pi t / period), which acts through friction.level_per_temperature. Both plants.
struct AmbientTemperature {
  double amplitude = 0;
  double period = 1;

  /// Ts - T0 at t (s), K.
  double RiseAt(double t) const {
    return amplitude == 0 ? 0 : amplitude * std::sin(2 * std::numbers::pi * t / period);
  }

  template <class A>
  void Serialize(A* a) {
    a->Field("amplitude", &amplitude, Needed("K", "size of the sine"));
    a->Field("period", &period, Needed("s", "of the sine", kPositive));
  }
};

/// The load that the joint transmits: 0 and `load` in turn, each for half a period; friction grows
/// by gain |load|, and the log holds the load. Ideal plant only.
struct LoadChange {
  double load = 0;
  double gain = 0;
  double period = 1;

  template <class A>
  void Serialize(A* a) {
    a->Field("load", &load, Needed("N.m", "during the second half of each period"));
    a->Field("gain", &gain, Needed("", "growth of the level for each unit of load", kNotNegative));
    a->Field("period", &period, Needed("s", "of the load", kPositive));
  }
};

struct FirstOrderLag {
  double time_constant = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("time_constant", &time_constant,
             Needed("s", "of the low-pass; 0: none", kNotNegative));
  }
};

struct Encoder {
  double resolution = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("resolution", &resolution, Needed("rad", "size of a step; 0: none", kNotNegative));
  }
};

struct HoldParity {
  double level = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("level", &level, Needed("N.m", "against the motion, in the second, fourth, ... hold"));
  }
};

struct StepInTime {
  double level = 0;
  double time = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("level", &level, Needed("N.m", "against the motion, from then on"));
    a->Field("time", &time, Needed("s", "of the change", kNotNegative));
  }
};

/// level exp(-t / time_constant)
struct RunIn {
  double level = 0;
  double time_constant = 1;

  template <class A>
  void Serialize(A* a) {
    a->Field("level", &level, Needed("N.m", "against the motion, at the start"));
    a->Field("time_constant", &time_constant, Needed("s", "of its decay", kPositive));
  }
};

// Forces that no model of an identifier holds.

struct Backlash {
  double level = 0;
  double way = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("level", &level, Needed("N.m", "what the friction lacks"));
    a->Field("way", &way, Needed("rad", "distance over which it lacks that", kNotNegative));
  }
};

/// The friction lacks level exp(-s / way) after the distance s.
struct Hysteresis {
  double level = 0;
  double way = 1;

  template <class A>
  void Serialize(A* a) {
    a->Field("level", &level, Needed("N.m", "what it lacks at first"));
    a->Field("way", &way, Needed("rad", "distance over which it returns to 63 %", kPositive));
  }
};

/// slope (u - |v|) joins the level, u being |v| after a first-order low-pass.
struct Memory {
  double slope = 0;
  double time_constant = 1;

  template <class A>
  void Serialize(A* a) {
    a->Field("slope", &slope, Needed("N.m.s/rad", "of the friction over the speed"));
    a->Field("time_constant", &time_constant, Needed("s", "of the low-pass", kPositive));
  }
};

/// coefficient v |v|
struct QuadraticDrag {
  double coefficient = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("coefficient", &coefficient, Needed("N.m.s^2/rad^2", "of the square of the speed"));
  }
};

/// amplitude sin(2 pi p / period)
struct Ripple {
  double amplitude = 0;
  double period = 1;

  template <class A>
  void Serialize(A* a) {
    a->Field("amplitude", &amplitude, Needed("N.m", "size of the sine"));
    a->Field("period", &period, Needed("rad", "of the sine", kPositive));
  }
};

/// stiffness p
struct Spring {
  double stiffness = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("stiffness", &stiffness, Needed("N.m/rad", "of the spring"));
  }
};

/// inertia dv/dt; between the samples where speeds are held.
struct Inertia {
  double inertia = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("inertia", &inertia, Needed("kg.m^2", "of the mass", kNotNegative));
  }
};

struct HiddenForces {
  Backlash backlash;
  Hysteresis hysteresis;
  Memory memory;
  QuadraticDrag quadratic_drag;
  Ripple ripple;
  Spring spring;
  Inertia inertia;

  template <class A>
  void Serialize(A* a) {
    a->Field("backlash", &backlash,
             LeftOut("after each change of direction the friction lacks a level for some "
                     "distance, as with play in a gear"));
    a->Field("hysteresis", &hysteresis,
             LeftOut("after each change of direction the friction lacks a level that dies "
                     "away with the distance, as bristles that bend leave it"));
    a->Field("memory", &memory,
             LeftOut("viscous friction that follows the speed late, as a film of oil does"));
    a->Field("quadratic_drag", &quadratic_drag,
             LeftOut("friction that grows with the square of the speed"));
    a->Field("ripple", &ripple,
             LeftOut("ripple of the level over position, alike in both directions"));
    a->Field("spring", &spring, LeftOut("a spring between joint and base"));
    a->Field("inertia", &inertia, LeftOut("the torque that accelerates a mass stays in the log"));
  }
};

/// Something that leans on the joint for a while: the motor gives `torque` besides, whichever way it moves.
struct Contact {
  double torque = 0;
  double begin = 0;
  double end = 0;

  /// At each of some times, s. [N] N.m or N
  Eigen::VectorXd TorqueAlong(const Eigen::VectorXd& time) const {
    return time.unaryExpr([this](double t) { return t >= begin && t < end ? torque : 0.0; });
  }

  template <class A>
  void Serialize(A* a) {
    a->Field("torque", &torque, Needed("N.m", "of the motor against it"));
    a->Field("begin", &begin, Needed("s", "of the contact", kNotNegative));
    a->Field("end", &end, Needed("s", "of the contact", kNotNegative));
  }
};

struct Disturbances {
  Outliers outliers;
  ColouredNoise coloured_noise;
  UnevenNoise uneven_noise;
  PeriodicTorque periodic_torque;
  Gravity gravity;
  AmbientDrift ambient_drift;
  AmbientTemperature ambient_temperature;
  LoadChange load_change;
  FirstOrderLag torque_lag, velocity_filter;
  Delay stale_position;
  Encoder encoder;
  HoldParity hold_parity;
  StepInTime step_in_time;
  RunIn run_in;
  Contact contact;
  HiddenForces hidden;
  SensorFaults faults;
  bool without_velocity = false;
  std::optional<Thermal> second_heat;  // fed by the same W

  template <class A>
  void Serialize(A* a) {
    a->Field("outliers", &outliers,
             LeftOut("single samples of the torque that are far off, at random"));
    a->Field("coloured_noise", &coloured_noise,
             LeftOut("noise of the torque that remembers, AR(1)"));
    a->Field("uneven_noise", &uneven_noise,
             LeftOut("white noise of the torque that grows with friction and speed"));
    a->Field("periodic_torque", &periodic_torque,
             LeftOut("a torque that is periodic in time, not in angle"));
    a->Field("gravity", &gravity,
             LeftOut("sine sin p + cosine cos p stays in the torque (`ideal`)"));
    a->Field("ambient_drift", &ambient_drift,
             LeftOut("the level of friction follows the room (`ideal`)"));
    a->Field(
        "ambient_temperature", &ambient_temperature,
        LeftOut("the room's temperature swings; acts through `friction.level_per_temperature`"));
    a->Field("load_change", &load_change,
             LeftOut("a payload is picked up and put down; the log holds the load (`ideal`)"));
    a->Field(
        "torque_lag", &torque_lag,
        LeftOut("the logged friction has passed a first-order low-pass before the noise joins it"));
    a->Field("velocity_filter", &velocity_filter,
             LeftOut("the logged velocity, with its noise, has passed a first-order low-pass"));
    a->Field("stale_position", &stale_position,
             LeftOut("the logged position is that of some samples ago"));
    a->Field("encoder", &encoder, LeftOut("the logged position comes in whole steps"));
    a->Field(
        "hold_parity", &hold_parity,
        LeftOut(
            "every other hold of a speed has a higher level, as a load that nobody logs makes it"));
    a->Field("step_in_time", &step_in_time,
             LeftOut("the level changes at once, as lubrication or a knock changes it"));
    a->Field("run_in", &run_in, LeftOut("a level that dies away, no matter how warm"));
    a->Field("contact", &contact, LeftOut("something leans on the joint for a while"));
    a->Flag("without_velocity", &without_velocity, "the log has no velocity column");
    a->Field("second_heat", &second_heat,
             {.meaning = "a second stage of warming in addition to the friction's own (`ideal`)"});
    hidden.Serialize(a);
    faults.Serialize(a);
  }
};

}  // namespace warmjoint
