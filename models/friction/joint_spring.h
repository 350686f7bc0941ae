// What a joint spring with a yield asks of the friction that it holds in MuJoCo's step, for those who put such springs into models and those who write
// them for others.
#pragma once

#include <warmjoint/friction.h>

namespace warmjoint {

/// The stiffest mode of all springs of a tree, M^-1 h^2 K, in any pose. Why 1: the step takes springs explicitly and carries 4, of which servos may
/// take 3; a mode then has six steps in a period.
inline constexpr double kStiffestSpringMode = 1;

/// The stiffness of a spring, N.m/rad or N/m. inertia: with the others of its tree free, kg.m^2 or kg; coupling: the largest eigenvalue of M^-1 times the
/// diagonal of these over the tree; timestep: s.
inline double SpringStiffness(double inertia, double coupling, double timestep) {
  return kStiffestSpringMode * inertia / (coupling * timestep * timestep);
}

/// The least viscous that lets a held joint come to rest, N.m.s/rad or N.s/m. level: at rest, N.m or N. Why: the spring of a joint that has come to rest
/// rings with the time constant 2 M / viscous, which then is at most that in which the level by itself brakes the joint from 20 rad/s (2 m/s);
/// joints of robots do not exceed that by much.
inline double LeastViscous(double level, JointKind kind) {
  return 2 * level / (kind == JointKind::rotary ? 20 : 2);
}

/// How far a joint may give way before it slides, as with the plugin, rad or m.
inline double LargestGive(JointKind kind) { return kind == JointKind::rotary ? 0.05 : 0.005; }

}  // namespace warmjoint
