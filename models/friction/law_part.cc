#include "models/friction/law_part.h"

#include <algorithm>

namespace warmjoint::inline models {

LawPart PartOf(std::string_view name) {
  for (const Law& law : Laws()) {
    const auto found = std::ranges::find(law.parameters, name, &ParameterInfo::name);
    if (found != law.parameters.end()) return found->part;
  }
  return LawPart::other;
}

std::optional<size_t> PlaceOf(LawPart part, const Law& law) {
  const auto found = std::ranges::find(law.parameters, part, &ParameterInfo::part);
  if (found == law.parameters.end()) return std::nullopt;
  return static_cast<size_t>(found - law.parameters.begin());
}

}  // namespace warmjoint::inline models
