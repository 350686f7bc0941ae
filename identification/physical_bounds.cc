#include "identification/physical_bounds.h"

#include <algorithm>

#include "models/friction/parameter_rows.h"

namespace warmjoint {

bool LeavesBounds(const std::vector<FitParameter>& parameters) {
  return std::ranges::any_of(parameters, [](const FitParameter& one) {
    return one.role == Role::law && !(one.value >= one.lower && one.value <= one.upper);
  });
}

bool RisesFromRest(const Friction& friction) {
  const auto at_rest = friction.parameters.find(std::string(kStaticRow.name));
  const auto coulomb = friction.parameters.find(std::string(kCoulombRow.name));
  const auto rise = friction.parameters.find(std::string(kStaticRiseRow.name));
  const auto none = friction.parameters.end();
  // a law holds its rise as a parameter of its own, or as two levels
  if (rise != none && rise->second < 0) return true;
  return at_rest != none && coulomb != none && at_rest->second < coulomb->second;
}

bool GivesFriction(const Fit& fit) {
  const bool stands = !fit.refusal && !IsRefused(fit.causes);
  return stands && !LeavesBounds(fit.parameters) && !RisesFromRest(fit.friction);
}

}  // namespace warmjoint
