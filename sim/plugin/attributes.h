// Configuration attributes of the plugin `warmjoint.friction`.
#pragma once

#include <warmjoint/friction.h>

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "models/foundation/bad_input.h"

namespace warmjoint::inline sim {

/// One attribute that <config key= value=> may give.
struct PluginAttribute {
  std::string name;
  std::string unit;   // of rotary joints; empty where it is no quantity
  std::string bound;  // what is allowed
  std::string meaning;
};

/// All attributes: `law`, `file`, `joints`, `instance`, `folder`, `gear`, the parameters of every
/// law, the thermal ones, the options (FrictionOptions), `maps`, `initial_energy`.
const std::vector<PluginAttribute>& PluginAttributes();

/// Reads the value of an attribute by its name; empty where it was not given.
using AttributeReader = std::function<std::string(const std::string& name)>;

/// Friction by the name of its joint; under "" that of every joint.
using FrictionOfJoints = std::map<std::string, Friction>;

/// The friction that the attributes describe, checked. Throws BadInput, from `place`, naming
/// attribute, value and bound for: no number ("5x"), a value out of bounds, a parameter that the
/// law lacks or needs, `file` or `joints` beside attributes that they would contradict, a joint
/// twice in `joints`.
FrictionOfJoints ReadAttributes(const AttributeReader& read, const Place& place);

/// Heat at a reset by the name of its joint, {E1, E2}, N.m or N; under "" that of every joint.
using InitialEnergies = std::map<std::string, std::array<double, 2>>;

/// The attribute `initial_energy`: a number, two in a list for two stages of warming, or an object
/// of these by joint. Checked against the joints' friction; throws BadInput.
InitialEnergies ReadInitialEnergy(const AttributeReader& read, const FrictionOfJoints& joints,
                                  const Place& place);

/// Path, size and time of the friction file that the attributes name, which tell whether it is still
/// the same; empty where they name none.
std::string FileStamp(const AttributeReader& read);

}  // namespace warmjoint::inline sim
