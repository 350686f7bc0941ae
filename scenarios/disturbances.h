// What acts on a joint or on its log beside friction and white noise. All zero: nothing.
#pragma once

#include <optional>
#include <string_view>

#include "models/friction/thermal.h"

namespace warmjoint::inline scenarios {

/// Single samples of the logged torque that are far off, at random.
struct Outliers {
  double fraction = 0;  // of the samples, below 1
  double size = 0;      // standard deviation of what is added to them, N.m or N

  bool operator==(const Outliers&) const = default;
};

/// Noise of the torque that remembers, AR(1): n[i+1] = a n[i] + sqrt(1 - a^2) deviation w[i],
/// a = exp(-h / correlation_time), from its stationary distribution on.
struct ColouredNoise {
  double deviation = 0;         // standard deviation, N.m or N
  double correlation_time = 1;  // s

  bool operator==(const ColouredNoise&) const = default;
};

/// A torque amplitude sin(2 pi t / period + phase) that has nothing to do with the joint's angle,
/// the phase drawn for each realization.
struct PeriodicTorque {
  double amplitude = 0;  // N.m or N
  double period = 1;     // s

  bool operator==(const PeriodicTorque&) const = default;
};

/// G = sine sin p + cosine cos p of Eq. (6). Ideal plant only: a robot has its own.
struct Gravity {
  double sine = 0;    // N.m or N
  double cosine = 0;  // N.m or N

  bool operator==(const Gravity&) const = default;
};

/// The level of friction follows the ambient temperature: amplitude sin(2 pi t / period) joins E,
/// the limit that the paper states. Ideal plant only.
struct AmbientDrift {
  double amplitude = 0;  // N.m or N
  double period = 1;     // s

  bool operator==(const AmbientDrift&) const = default;
};

/// The ambient temperature swings about the one at which the law's parameters hold: a rise of
/// amplitude sin(2 pi t / period), which acts through friction.level_per_temperature. Both plants.
struct AmbientTemperature {
  double amplitude = 0;  // K
  double period = 1;     // s

  /// Ts - T0 at t (s), K.
  double RiseAt(double t) const;

  bool operator==(const AmbientTemperature&) const = default;
};

/// The load that the joint transmits: 0 and `load` in turn, each for half a period; friction grows
/// by gain |load|, and the log holds the load. Ideal plant only.
struct LoadChange {
  double load = 0;    // N.m or N
  double gain = 0;    // growth of the level for each unit of load, dimensionless
  double period = 1;  // s

  bool operator==(const LoadChange&) const = default;
};

struct Disturbances {
  Outliers outliers;
  ColouredNoise coloured_noise;
  PeriodicTorque periodic_torque;
  Gravity gravity;
  AmbientDrift ambient_drift;
  AmbientTemperature ambient_temperature;
  LoadChange load_change;
  std::optional<Thermal> second_heat;  // a second energy state fed by the same W; ideal plant only

  bool operator==(const Disturbances&) const;
};

/// Name of the first disturbance that only the ideal plant knows; empty where there is none.
std::string_view IdealOnly(const Disturbances& disturbances);

}  // namespace warmjoint::inline scenarios
