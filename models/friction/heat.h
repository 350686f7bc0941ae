// The heat of a joint's own losses and of its surroundings, sampled.
#pragma once

#include <warmjoint/friction.h>

#include <optional>

#include "models/friction/thermal.h"

namespace warmjoint {

/// What heats and cools a joint over a step, constant meanwhile.
struct Heating {
  double loss = 0;          // W
  double ambient_rise = 0;  // Ts - T0, K
  double speed = 0;         // v, rad/s or m/s
};

/// Energy states of up to two stages, both fed by the same loss W:
///   E1' = te1 E1 + ke1 W + (1 - te1) kT (Ts - T0),   E2' = te2 E2 + ke2 W            (22)
/// With kT (level_per_temperature) given, the first stage is the temperature form (17) of a joint
/// at T = T0 + E1 / kT in surroundings at Ts: dT/dt = -(T - Ts) / tau + (k / kT) W / tau. T0 is the
/// temperature at which the law's parameters hold. Exact for W and Ts constant during a step.
struct Heat {
  DiscreteThermal first{0, 1};
  DiscreteThermal second{0, 1};
  double ambient_gain = 0;  // (1 - te1) kT, N.m/K or N/K

  /// Whether the loss alone heats one stage, whatever else happens: First is then ThermalStep by the
  /// numbers of `first`, which the plugin takes for many joints at once, and Second leaves E2 as it
  /// is. A number that First or Second reads besides has to make this false.
  bool IsOneStage() const { return ambient_gain == 0 && second.gain == 0 && second.pole == 1; }

  double First(double energy, const Heating& by) const {
    return ThermalStep(first.gain, first.pole, energy, by.loss) + ambient_gain * by.ambient_rise;
  }
  double Second(double energy, const Heating& by) const {
    return ThermalStep(second.gain, second.pole, energy, by.loss);
  }
};

/// h: step, s. Without thermal, energies stay as they are.
inline Heat DiscretiseHeat(const Friction& friction, double h) {
  Heat heat;
  if (!friction.thermal) return heat;
  heat.first = Discretise(*friction.thermal, h);
  heat.ambient_gain =
      friction.level_per_temperature * HoldOver(h, friction.thermal->time_constant).cooling;
  if (friction.second_thermal) heat.second = Discretise(*friction.second_thermal, h);
  return heat;
}

}  // namespace warmjoint
