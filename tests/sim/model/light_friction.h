// A friction that any link of some grams can carry, and a mesh, for tests of models.
#pragma once

#include <mujoco/mujoco.h>
#include <warmjoint/friction.h>

#include <string>
#include <vector>

namespace warmjoint::test {

/// A mesh of four triangles, OBJ.
inline constexpr char kTetrahedron[] =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

inline Friction LightFriction() { return {"coulomb", {{"coulomb", 0.5}}, Thermal{-0.1, 60}}; }

/// Joints of the actuators that are plugins, in their order.
inline std::vector<std::string> FrictionJoints(const mjModel* m) {
  std::vector<std::string> joints;
  for (int i = 0; i < m->nactuator; ++i) {
    if (m->actuator_plugin[i] < 0) continue;
    joints.emplace_back(mj_id2name(m, mjOBJ_JOINT, m->actuator_trnid[2 * i]));
  }
  return joints;
}

}  // namespace warmjoint::test
