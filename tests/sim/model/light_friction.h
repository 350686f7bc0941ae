// A friction that any link of some grams can carry, for tests of attaching.
#pragma once

#include <mujoco/mujoco.h>
#include <warmjoint/friction.h>

#include <string>
#include <vector>

namespace warmjoint::test {

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
