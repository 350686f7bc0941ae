#include "identification/find_parameter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "models/friction/thermal_names.h"

namespace warmjoint::inline identification {

std::string NameOf(Role role, int which) {
  switch (role) {
    case Role::heat:
      return std::string(which == 0 ? kGainName : kTimeConstantName);
    case Role::start:
      return "initial_energy";
    case Role::jump:
      return fmt::format("energy_jump_{}", which + 1);
    case Role::inertia:
      return std::string(kInertiaName);
    case Role::lag:
      return std::string(kTorqueLagName);
    case Role::law:
    case Role::gravity:
      break;
  }
  assert(false);
  return "";
}

const EstimatedParameter* Find(Role role, const Estimate& estimate, int which) {
  return estimate.Find(NameOf(role, which));
}

const EstimatedParameter* Find(LawPart part, const Estimate& estimate) {
  const auto found =
      std::ranges::find(estimate.parameters, part,
                        [](const EstimatedParameter& parameter) { return PartOf(parameter.name); });
  return found == estimate.parameters.end() ? nullptr : &*found;
}

}  // namespace warmjoint::inline identification
