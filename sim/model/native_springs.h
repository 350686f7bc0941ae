// Friction as MuJoCo's own plastic joint springs (`stiffness` and `springyield`, MuJoCo 4.0), which need no plugin.
#pragma once

#include <mujoco/mujoco.h>
#include <warmjoint/attach.h>

#include <string>
#include <vector>

#include "models/foundation/bad_input.h"

namespace warmjoint {

/// What a joint's spring with a yield holds: viscous_coulomb, coulomb or stribeck with its heat. What it cannot hold is left out or replaced.
struct SpringFriction {
  FrictionForJoint friction;
  std::vector<std::string> lost;  // what was left out, and by how much that is off
};

/// The nearest friction that a spring with a yield holds. kind: of the joint.
SpringFriction InSpring(const FrictionForJoint& given, JointKind kind);

/// The stiffness of each degree of freedom's spring, N.m/rad or N/m: of those that `takes` names, [nv]; 0 of the others.
std::vector<double> SpringStiffnesses(const mjModel* m, const std::vector<char>& takes);

/// Gives the joints springs with a yield in place of friction's level, and, as the driver of the yields reads them, arrays "native/NUMBER" and a
/// tuple "native" of the joints. frictions: of joints that exist, in the order of the model; m: the spec as it compiles, with the joints'
/// damping as their viscous.
/// Throws BadInput, from `place`, with the nearest numbers that hold, for what springs cannot hold unless
/// options.approximate replaces it, a spring of the joint's own, an integrator that takes no damping implicitly or draws springs along, and a
/// step too long.
std::vector<NativeSpring> AddSprings(mjSpec& spec, const mjModel* m,
                                     const std::vector<FrictionForJoint>& frictions,
                                     const AttachOptions& options, const Place& place,
                                     std::vector<std::string>& notices);

/// What the compiled spec shows: the yields in the unit of the model's angles, and keyframes that begin with relaxed springs. m: the spec with springs
/// as it compiles, which must be compiled once more.
void FinishSprings(mjSpec& spec, const mjModel* m, const std::vector<NativeSpring>& springs);

}  // namespace warmjoint
