// What acts on a joint or on its log beside friction and white noise. All zero: nothing.
#pragma once

#include <warmjoint/field.h>
#include <warmjoint/friction.h>

#include <optional>
#include <string_view>

#include "scenarios/hidden_forces.h"
#include "scenarios/sensor_faults.h"

namespace warmjoint {

/// Single samples of the logged torque that are far off, at random.
struct Outliers {
  double fraction = 0;   // of the samples, below 1
  double size = 0;       // standard deviation of what is added to them, N.m or N
  double one_sided = 0;  // 1: what is added is never negative

  template <class A>
  void Serialize(A* a) {
    a->Field("fraction", &fraction, {.bounds = {.at_least = 0, .below = 1}, .needed = kGiveNumber});
    a->Field("size", &size, {.unit = "N.m", .bounds = {.at_least = 0}, .needed = kGiveNumber});
    a->Field("one_sided", &one_sided, {.bounds = {.at_least = 0, .at_most = 1}});
  }

  bool operator==(const Outliers&) const = default;
};

/// Noise of the torque that remembers, AR(1): n[i+1] = a n[i] + sqrt(1 - a^2) deviation w[i],
/// a = exp(-h / correlation_time), from its stationary distribution on.
struct ColouredNoise {
  double deviation = 0;         // standard deviation, N.m or N
  double correlation_time = 1;  // s

  template <class A>
  void Serialize(A* a) {
    a->Field("deviation", &deviation,
             {.unit = "N.m", .bounds = {.at_least = 0}, .needed = kGiveNumber});
    a->Field("correlation_time", &correlation_time,
             {.unit = "s", .bounds = {.above = 0}, .needed = kGiveNumber});
  }

  bool operator==(const ColouredNoise&) const = default;
};

/// White noise of the torque beside Noise.torque whose deviation grows with the friction f and the speed v:
/// of_torque |f| + of_speed |v|.
struct UnevenNoise {
  double of_torque = 0;
  double of_speed = 0;  // N.m.s/rad or N.s/m

  template <class A>
  void Serialize(A* a) {
    a->Field("of_torque", &of_torque, {.bounds = {.at_least = 0}});
    a->Field("of_speed", &of_speed, {.unit = "N.m.s/rad", .bounds = {.at_least = 0}});
  }

  bool operator==(const UnevenNoise&) const = default;
};

/// A torque amplitude sin(2 pi t / period + phase) that has nothing to do with the joint's angle,
/// the phase drawn for each realization.
struct PeriodicTorque {
  double amplitude = 0;  // N.m or N
  double period = 1;     // s

  template <class A>
  void Serialize(A* a) {
    a->Field("amplitude", &amplitude, {.unit = "N.m", .needed = kGiveNumber});
    a->Field("period", &period, {.unit = "s", .bounds = {.above = 0}, .needed = kGiveNumber});
  }

  bool operator==(const PeriodicTorque&) const = default;
};

/// G = sine sin p + cosine cos p of Eq. (6). Ideal plant only: a robot has its own.
struct Gravity {
  double sine = 0;    // N.m or N
  double cosine = 0;  // N.m or N

  template <class A>
  void Serialize(A* a) {
    a->Field("sine", &sine, {.unit = "N.m"});
    a->Field("cosine", &cosine, {.unit = "N.m"});
  }

  bool operator==(const Gravity&) const = default;
};

/// The level of friction follows the ambient temperature: amplitude sin(2 pi t / period) joins E,
/// the limit that the paper states. Ideal plant only.
struct AmbientDrift {
  double amplitude = 0;  // N.m or N
  double period = 1;     // s

  template <class A>
  void Serialize(A* a) {
    a->Field("amplitude", &amplitude, {.unit = "N.m", .needed = kGiveNumber});
    a->Field("period", &period, {.unit = "s", .bounds = {.above = 0}, .needed = kGiveNumber});
  }

  bool operator==(const AmbientDrift&) const = default;
};

/// The ambient temperature swings about the one at which the law's parameters hold: a rise of
/// amplitude sin(2 pi t / period), which acts through friction.level_per_temperature. Both plants.
struct AmbientTemperature {
  double amplitude = 0;  // K
  double period = 1;     // s

  /// Ts - T0 at t (s), K.
  double RiseAt(double t) const;

  template <class A>
  void Serialize(A* a) {
    a->Field("amplitude", &amplitude, {.unit = "K", .needed = kGiveNumber});
    a->Field("period", &period, {.unit = "s", .bounds = {.above = 0}, .needed = kGiveNumber});
  }

  bool operator==(const AmbientTemperature&) const = default;
};

/// The load that the joint transmits: 0 and `load` in turn, each for half a period; friction grows
/// by gain |load|, and the log holds the load. Ideal plant only.
struct LoadChange {
  double load = 0;    // N.m or N
  double gain = 0;    // growth of the level for each unit of load, dimensionless
  double period = 1;  // s

  template <class A>
  void Serialize(A* a) {
    a->Field("load", &load, {.unit = "N.m", .needed = kGiveNumber});
    a->Field("gain", &gain, {.bounds = {.at_least = 0}, .needed = kGiveNumber});
    a->Field("period", &period, {.unit = "s", .bounds = {.above = 0}, .needed = kGiveNumber});
  }

  bool operator==(const LoadChange&) const = default;
};

/// The logged friction passes a first-order low-pass before the noise joins it, as a slow sensor or
/// a drive's filter has it.
struct TorqueLag {
  double time_constant = 0;  // s; 0: none

  template <class A>
  void Serialize(A* a) {
    a->Field("time_constant", &time_constant,
             {.unit = "s", .bounds = {.at_least = 0}, .needed = kGiveNumber});
  }

  bool operator==(const TorqueLag&) const = default;
};

/// The logged velocity, with its noise, has passed a first-order low-pass.
struct VelocityFilter {
  double time_constant = 0;  // s; 0: none

  template <class A>
  void Serialize(A* a) {
    a->Field("time_constant", &time_constant,
             {.unit = "s", .bounds = {.at_least = 0}, .needed = kGiveNumber});
  }

  bool operator==(const VelocityFilter&) const = default;
};

/// The logged position is that of some samples ago.
struct StalePosition {
  int samples = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("samples", &samples, {.bounds = {.at_least = 0}, .needed = kGiveNumber});
  }

  bool operator==(const StalePosition&) const = default;
};

/// The logged position comes in whole steps.
struct Encoder {
  double resolution = 0;  // rad or m; 0: none

  template <class A>
  void Serialize(A* a) {
    a->Field("resolution", &resolution,
             {.unit = "rad", .bounds = {.at_least = 0}, .needed = kGiveNumber});
  }

  bool operator==(const Encoder&) const = default;
};

/// Every other hold of a speed has a higher level, as a load that nobody logs makes it.
struct HoldParity {
  double level = 0;  // N.m or N against the motion, in the second, fourth, ... hold

  template <class A>
  void Serialize(A* a) {
    a->Field("level", &level, {.unit = "N.m", .needed = kGiveNumber});
  }

  bool operator==(const HoldParity&) const = default;
};

/// The level changes at once, as lubrication or a knock changes it.
struct StepInTime {
  double level = 0;  // N.m or N against the motion, from then on
  double time = 0;   // s

  template <class A>
  void Serialize(A* a) {
    a->Field("level", &level, {.unit = "N.m", .needed = kGiveNumber});
    a->Field("time", &time, {.unit = "s", .bounds = {.at_least = 0}, .needed = kGiveNumber});
  }

  bool operator==(const StepInTime&) const = default;
};

/// A level that runs in: level exp(-t / time_constant) against the motion, no matter how warm.
struct RunIn {
  double level = 0;          // N.m or N
  double time_constant = 1;  // s

  template <class A>
  void Serialize(A* a) {
    a->Field("level", &level, {.unit = "N.m", .needed = kGiveNumber});
    a->Field("time_constant", &time_constant,
             {.unit = "s", .bounds = {.above = 0}, .needed = kGiveNumber});
  }

  bool operator==(const RunIn&) const = default;
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
  TorqueLag torque_lag;
  VelocityFilter velocity_filter;
  StalePosition stale_position;
  Encoder encoder;
  HoldParity hold_parity;
  StepInTime step_in_time;
  RunIn run_in;
  HiddenForces hidden;
  SensorFaults faults;
  bool without_velocity = false;       // the log has no velocity column
  std::optional<Thermal> second_heat;  // a second energy state fed by the same W; ideal plant only

  template <class A>
  void Serialize(A* a) {
    constexpr FieldInfo absent{.at_default = AtDefault::left_out};
    a->Field("outliers", &outliers, absent);
    a->Field("coloured_noise", &coloured_noise, absent);
    a->Field("uneven_noise", &uneven_noise, absent);
    a->Field("periodic_torque", &periodic_torque, absent);
    a->Field("gravity", &gravity, absent);
    a->Field("ambient_drift", &ambient_drift, absent);
    a->Field("ambient_temperature", &ambient_temperature, absent);
    a->Field("load_change", &load_change, absent);
    a->Field("torque_lag", &torque_lag, absent);
    a->Field("velocity_filter", &velocity_filter, absent);
    a->Field("stale_position", &stale_position, absent);
    a->Field("encoder", &encoder, absent);
    a->Field("hold_parity", &hold_parity, absent);
    a->Field("step_in_time", &step_in_time, absent);
    a->Field("run_in", &run_in, absent);
    a->Flag("without_velocity", &without_velocity);
    a->Field("second_heat", &second_heat);
    hidden.Serialize(a);
    faults.Serialize(a);
  }

  bool operator==(const Disturbances&) const;
};

/// Name of the first disturbance that only the ideal plant knows; empty where there is none.
std::string_view IdealOnly(const Disturbances& disturbances);

}  // namespace warmjoint
