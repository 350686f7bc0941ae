// What the attributes of plugin instances describe, read once for all data of all models.
#pragma once

#include <mujoco/mujoco.h>

#include <array>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "models/foundation/bad_input.h"
#include "models/friction/joint_friction.h"
#include "sim/plugin/attributes.h"

namespace warmjoint::inline sim {

/// One joint's friction as it was described, and ready for a timestep.
struct PreparedJoint {
  Friction description;
  JointFriction friction;
  std::array<double, 2> initial_energy{};  // {E1, E2} at a reset, N.m or N
};

/// An instance as its attributes describe it.
struct PreparedInstance {
  std::string written_name;                     // attribute `instance`; empty where not given
  std::map<std::string, PreparedJoint> joints;  // by the name in `joints`; "": every joint
};

/// The values of all the instance's attributes, as the model holds them: one after the other, each
/// ended by a 0.
inline std::string_view AttributeText(const mjModel* m, int instance) {
  const bool last = instance + 1 == m->nplugin;
  const auto begin = static_cast<size_t>(m->plugin_attradr[instance]);
  const auto end = static_cast<size_t>(last ? m->npluginattr : m->plugin_attradr[instance + 1]);
  return {m->plugin_attr + begin, end - begin};
}

/// The instance's attributes, read and checked, and its maps surveyed. Instances with the same
/// attributes share one, so that copies of data and lists of models parse once; a friction file
/// that changed is read again. Any thread may call it. Throws BadInput from `place`.
std::shared_ptr<const PreparedInstance> PrepareInstance(const mjModel* m, int instance,
                                                        const Place& place);

}  // namespace warmjoint::inline sim
