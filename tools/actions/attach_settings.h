// What attaching friction to a model is told, and what friction files say of themselves.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/model/attach.h"

namespace warmjoint::inline tools {

/// What attaching changes besides adding friction, each under the name that it has on the command
/// line.
struct AttachSettings {
  std::string form = "actuator";                            // --as: actuator or passive
  std::vector<std::pair<std::string, double>> armatures{};  // of a name or pattern: kg.m^2 or kg
  std::string integrator{};          // of IntegratorNames; empty: the model's
  std::optional<double> timestep{};  // s; the model's where not given
  std::vector<std::pair<std::string, std::string>> packages{};  // name: folder, of a URDF's meshes
};

/// Euler, RK4, implicit, ...
std::vector<std::string> IntegratorNames();

/// The settings, checked. Throws BadInput.
AttachOptions CheckedOptions(const AttachSettings& settings);

/// The friction in `file` for the joints that `joint` names, with the heat that `initial` asks for
/// (InitialEnergy). Refuses an estimate without friction. Adds to `warnings` what the estimate's
/// own verdict says against its friction: identify --force writes such ones.
FrictionForJoint ReadFrictionForJoint(const std::string& joint, const std::string& file,
                                      const std::string& initial,
                                      std::vector<std::string>& warnings);

}  // namespace warmjoint::inline tools
