#include "identification/find_parameter.h"

#include <algorithm>

#include "identification/fit_parameters.h"
#include "models/friction/parameter_rows.h"

namespace warmjoint {

const EstimatedParameter* Find(Role role, const Estimate& estimate, int which) {
  return estimate.Find(NameOf(role, which));
}

std::optional<double> ValueOf(Role role, const Estimate& estimate) {
  const EstimatedParameter* found = Find(role, estimate);
  return found ? std::optional(found->value) : std::nullopt;
}

const EstimatedParameter* Find(LawPart part, const Estimate& estimate) {
  const auto found =
      std::ranges::find(estimate.parameters, part,
                        [](const EstimatedParameter& parameter) { return PartOf(parameter.name); });
  return found == estimate.parameters.end() ? nullptr : &*found;
}

}  // namespace warmjoint
