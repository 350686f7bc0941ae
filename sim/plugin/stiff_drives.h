// What the drives of a model add to its step explicitly.
#pragma once

#include <mujoco/mujoco.h>

#include <vector>

namespace warmjoint::inline sim {

/// Of each kinematic tree, the largest eigenvalue of M^-1 (h^2 K + 2 h C) over poses under an integrator,
/// K and C being the stiffness and damping of affine drives of joints; damping that the integrator takes
/// implicitly counts as -C. 0 under `discrete` and RK4, which carry more stiffness than bristles need, and
/// where all is so soft that BristlesOf does not change.
std::vector<double> StiffestDrives(const mjModel* m, int integrator);

}  // namespace warmjoint::inline sim
