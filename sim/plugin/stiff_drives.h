// What the drives and springs of a model add to its step explicitly.
#pragma once

#include <mujoco/mujoco.h>

#include <vector>

namespace warmjoint::inline sim {

/// Of each kinematic tree, the largest eigenvalue of M^-1 (h^2 K + 2 h C) over poses under an integrator: K + 2 C of a joint alone, in units of M/h^2 and M/h. K and C: stiffness and damping of
/// springs and affine drives, through any transmission; damping that the integrator takes implicitly
/// counts as -C. 0 under `discrete`, which takes stiffness implicitly, and under RK4, whose stages carry
/// more than a bystander's K of 4; and where nothing is stiff enough to matter to any BristlesOf.
std::vector<double> StiffestDrives(const mjModel* m, int integrator);

}  // namespace warmjoint::inline sim
