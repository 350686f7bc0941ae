// The heat in which a joint settles that slides at one speed for long.
#pragma once

#include <optional>
#include <vector>

#include "models/friction/friction_description.h"

namespace warmjoint::inline models {

/// The energies E1 and, with a second stage, E2, in N.m or N, of a joint that has slid at
/// `velocity`, rad/s or m/s, for much longer than its time constants, in surroundings at T0: Eq.
/// (21) with s = 0, E_i = k_i W and W = |F v| (19). Where friction is F0 + E, with F0 the cold one
/// at that velocity, this is
///   E = k |v| |F0| / (1 - k |v|),   k = k1 + k2;
/// with maps W is the mean over the positions that they cover (no load). Solved by bisection to
/// double precision, so that maps over energy and viscous_per_energy take part as they are.
/// Empty without heat; nothing where the losses grow for ever (k |v| >= 1).
/// friction: checked.
std::optional<std::vector<double>> SettledEnergy(const FrictionDescription& friction,
                                                 double velocity);

}  // namespace warmjoint::inline models
