// One public model put to the test: friction onto all its joints, then heat and rest.
#pragma once

#include <mujoco/mujoco.h>

#include <filesystem>
#include <string>

#include "sim/model/friction_actuator.h"

namespace warmjoint::test {

/// What came of it. All figures are the worst over the joints.
struct Trial {
  int joints = 0;         // hinges and slides with a name
  int nameless = 0;       // without one: attach cannot mean them
  std::string remedy;     // "" or the options that a refusal offered and that were then taken
  std::string failure;    // "" or why the model could not be used in the end
  int changed = 0;        // arrays of mjModel that should have stayed and did not
  double heat_error = 0;  // |E - Eq. (22)| over |E|, after one second at prescribed speeds
  double motion = 0;      // in the last half of one second of rest under gravity, over the give
};

/// Why a file is no robot for TryRobot: MuJoCo cannot load it by itself, or it has no named hinge or
/// slide. Empty where it is one.
std::string WhyNoRobot(const std::filesystem::path& model);

/// Attaches friction to every named hinge and slide of the model, in this form, and tries it:
/// asymmetric law, levels of 1.5 times the gravity load and a part of the largest one, heat of
/// -0.3 N.m/W and 20 s. A refusal that offers options of `attach` is followed once.
Trial TryRobot(const std::filesystem::path& model, FrictionForm form);

/// Number of the arrays of mjModel that differ, bit for bit, though attaching friction should leave
/// them alone: all but those of actuators, plugins, keyframes' act and ctrl, names and paths, and
/// the damping and frictionloss that the friction replaces; and, as actuators, what these change: the
/// effort limits of joints, whether trees sleep. Prints their names to stderr.
int CountChanges(const mjModel* before, const mjModel* after, FrictionForm form);

}  // namespace warmjoint::test
