// The bristle of Dahl and LuGre: a spring that relaxes towards its level with travel.
#pragma once

#include <algorithm>
#include <cmath>

#include "models/friction/bristle.h"

namespace warmjoint {

/// The same bristle, weakened so far that an explicit step carries it: its stiffness and damping
/// together are at most what MakeBristle gives. inertia: M, kg.m^2 or kg; h: s.
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
