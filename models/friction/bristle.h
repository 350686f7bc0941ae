// Bristles, step by step: the elasto-plastic one, which holds a joint at rest and slides at its level, and that of Dahl and
// LuGre, a spring that relaxes towards its level with travel.
#pragma once

#include <algorithm>
#include <cmath>

#include "models/friction/sign.h"

namespace warmjoint {

/// Spring and damper that carry the friction of a joint at rest.
struct Bristle {
  double stiffness = 0;  // N.m/rad or N/m
  double damping = 0;    // N.m.s/rad or N.s/m
};

/// Stiffness and damping in units of M/h^2 and M/h (M: effective inertia, h: step). An explicit
/// step is stable while (stiffness + 2 damping) lambda < 4, lambda being the largest eigenvalue of
/// the inverse inertia matrix scaled by the joints' M: 1 for a joint alone, at most 3.3 over the
/// poses of the arms that were tried; these values allow 4.4. The damping ratio of a joint alone is
/// 0.63.
inline constexpr double kBristleStiffness = 0.1;
inline constexpr double kBristleDamping = 0.4;

/// The bristle of a joint whose effective inertia is 1 kg.m^2 or kg, at step h (s).
inline Bristle UnitBristle(double h) { return {kBristleStiffness / (h * h), kBristleDamping / h}; }

/// `unit` for a joint with effective inertia M, kg.m^2 or kg.
inline Bristle ScaleBristle(const Bristle& unit, double inertia) {
  return {inertia * unit.stiffness, inertia * unit.damping};
}

struct BristleStep {
  double force = 0;      // friction, N.m or N; opposes the motion when it has the sign of v
  double load = 0;       // elastic part of the force after the step, the bristle's state
  bool sliding = false;  // whether the bristle has yielded in the direction of motion
};

/// One step of elastic, perfectly plastic friction (Prandtl's element with a damper; the limit of
/// Dupont et al. 2002 with a sharp elastic range):
///   s' = clamp(s + sigma0 h v, -L-, L+),   f = clamp(s' + sigma1 v, -L-, L+).
/// Below its level the bristle is a spring, so a load at rest causes no drift, whatever it does;
/// once yielded, f equals the level exactly. Passive for any v and any levels that are not
/// negative: f v h >= (s'^2 - s^2) / (2 sigma0).
/// load: s, N.m or N; v: rad/s or m/s; h: s; level(side): L+ for side 1 and L- for side -1, N.m or
/// N, a level below 0 counts as 0.
template <typename Level>
BristleStep StepBristle(const Bristle& bristle, double load, double v, double h,
                        const Level& level) {
  // elastic trial, then return to the level on the side of the load
  const double trial = load + bristle.stiffness * h * v;
  const int side = Sign(trial) != 0 ? Sign(trial) : 1;
  const double limit = std::max(0.0, level(side));
  const bool yields = side * trial >= limit;
  const double next = yields ? side * limit : trial;

  // the damper may turn the force over, then the level of the other side bounds it
  const double damped = next + bristle.damping * v;
  const double force = side * damped >= 0
                           ? side * std::min(side * damped, limit)
                           : -side * std::min(-side * damped, std::max(0.0, level(-side)));
  return {force, next, yields && side * v > 0};
}

/// A bristle weakened so far that an explicit step carries it: its stiffness and damping
/// together are at most those of UnitBristle. inertia: M, kg.m^2 or kg; h: s.
inline Bristle LimitBristle(const Bristle& bristle, double inertia, double h) {
  const double asked = h * (bristle.stiffness * h + 2 * bristle.damping);
  const double carried = (kBristleStiffness + 2 * kBristleDamping) * inertia;
  const double share = asked > carried ? carried / asked : 1;
  return {share * bristle.stiffness, share * bristle.damping};
}

/// One step of ds/dt = sigma0 (v - |v| s / g), f = s + (sigma1 / sigma0) ds/dt, exact for a
/// velocity that is constant during the step:
///   s' = g sign(v) + (s - g sign(v)) exp(-sigma0 h |v| / g),  f = s' + sigma1 (s' - s) / (sigma0
///   h)
/// f takes the end of the step, which makes it passive: f v h >= (s'^2 - s^2) / (2 sigma0). Where
/// the level falls below the load, LuGre's damper would push; f is then not less than 0.
/// load: s, N.m or N; v: rad/s or m/s; h: s; level(side): g on each side of motion, N.m or N, a
/// level below 0 counts as 0.
template <typename Level>
BristleStep StepLugreBristle(const Bristle& bristle, double load, double v, double h,
                             const Level& level) {
  if (v == 0) return {load, load, false};
  const int side = Sign(v);
  const double target = side * std::max(0.0, level(side));
  const double travel = bristle.stiffness * h * v;  // N.m or N, of a bristle that does not yield
  const double change =
      target == 0 ? -load : (target - load) * -std::expm1(-std::abs(travel / target));
  const double next = load + change;

  double force = next + bristle.damping / (bristle.stiffness * h) * change;
  if (change * v < 0) force = side * std::max(0.0, side * force);
  return {force, next, side * next > 0};
}

}  // namespace warmjoint
