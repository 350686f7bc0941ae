// Words of scenario files that stand for a choice.
#pragma once

#include "scenarios/scenario.h"
#include "scenarios/yaml_choice.h"

namespace warmjoint::inline scenarios {

inline const Choices<PlantKind>& PlantKinds() {
  static const Choices<PlantKind> kinds{{"ideal", PlantKind::ideal}, {"mujoco", PlantKind::mujoco}};
  return kinds;
}

inline const Choices<JointKind>& JointKinds() {
  static const Choices<JointKind> kinds{{"rotary", JointKind::rotary},
                                        {"linear", JointKind::linear}};
  return kinds;
}

}  // namespace warmjoint::inline scenarios
