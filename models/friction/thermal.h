// The thermal energy state: friction that its own losses and its surroundings change, Eqs. (19)-(22).
#pragma once

#include <warmjoint/friction.h>

#include <cmath>
#include <string_view>

#include "models/friction/sign.h"

namespace warmjoint {

/// In size, N.m/W or N/W; joints show some 1 N.m/W, and a larger number is one that slipped.
inline constexpr double kLargestThermalGain = 1e6;

// What these numbers are called in files and attributes.

inline constexpr std::string_view kGainName = Thermal::parameters[0].name;
inline constexpr std::string_view kTimeConstantName = Thermal::parameters[1].name;

/// Stands before both in a second stage.
inline constexpr std::string_view kSecondStage = "second_";

/// The sampled pair of Eq. (22).
inline constexpr std::string_view kDiscreteGainName = "thermal_gain_discrete";
inline constexpr std::string_view kPoleName = "thermal_pole";

/// The same, sampled with a zero-order hold, Eq. (22): E[i+1] = pole E[i] + gain W[i].
struct DiscreteThermal {
  double gain = 0;  // ke, N.m/W or N/W
  double pole = 0;  // te, dimensionless
};

/// One step of Eq. (22). energy: E[i], N.m or N; loss: W[i], W. Returns E[i+1], which is exact when
/// the loss is constant during the step; E[i] itself does not see W[i].
template <typename T, typename W>
T ThermalStep(const T& gain, const T& pole, const T& energy, const W& loss) {
  return pole * energy + gain * loss;
}

/// The zero-order hold of Eq. (22) over one step, at unit gain, and its derivatives by
/// theta = ln tau. With a = h/tau:
///   te = exp(-a), dte/dtheta = a te, d2te/dtheta2 = a (a - 1) te.
/// T: double, a dual number, or an Eigen::Array of several.
template <typename T = double>
struct ThermalHold {
  T ratio;    // a
  T pole;     // te
  T cooling;  // 1 - te, by expm1 so that h << tau loses no digits

  /// ratio: a, the step over the time constant.
  static ThermalHold Over(const T& ratio) {
    using std::exp;
    using std::expm1;
    return {ratio, T(exp(-ratio)), T(-expm1(-ratio))};
  }

  T Slope() const { return ratio * pole; }
  T Curvature() const { return (ratio - 1) * Slope(); }

  /// E[i+1] at unit gain, in J. energy: E[i], J; loss: W[i], W.
  template <typename W>
  T After(const T& energy, const W& loss) const {
    return ThermalStep(cooling, pole, energy, loss);
  }
};

/// The hold over a step of h, s.
inline ThermalHold<> HoldOver(double h, double time_constant) {
  return ThermalHold<>::Over(h / time_constant);
}

/// te = exp(-h/tau), ke = k (1 - te). h: step, s.
inline DiscreteThermal Discretise(const Thermal& thermal, double h) {
  const ThermalHold<> hold = HoldOver(h, thermal.time_constant);
  return {thermal.gain * hold.cooling, hold.pole};
}

/// The inverse of Discretise: tau = -h / ln(te), k = ke / (1 - te). 0 < te < 1.
inline Thermal Continuous(const DiscreteThermal& discrete, double h) {
  return {discrete.gain / (1 - discrete.pole), -h / std::log(discrete.pole)};
}

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

/// F = Fn + sign(v) E, Eq. (20). nominal: Fn(v); energy: E; all N.m or N.
template <typename T>
T WarmForce(double v, const T& nominal, const T& energy) {
  return nominal + T(Sign(v)) * energy;
}

/// W = |F v|, Eq. (19), in W.
template <typename T>
T Loss(double v, const T& force) {
  const T power = force * v;
  return power < T(0) ? T(-power) : power;
}

/// Whether warm friction pushes instead of braking: F v < 0, which happens once E < -Fn sign(v).
/// From there on the model has left its domain.
inline bool DrivesJoint(double v, double force) { return force * v < 0; }

}  // namespace warmjoint
