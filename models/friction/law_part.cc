#include "models/friction/law_part.h"

#include <algorithm>
#include <array>
#include <utility>

#include "models/friction/parameter_rows.h"

namespace warmjoint::inline models {
namespace {

constexpr std::array kParts{
    std::pair{kViscousRow.name, LawPart::slope},
    std::pair{kCoulombRow.name, LawPart::level},
    std::pair{kCoulombPositiveRow.name, LawPart::level},
    std::pair{kCoulombNegativeRow.name, LawPart::level},
    std::pair{kStaticRow.name, LawPart::rest_level},
    std::pair{kStaticRiseRow.name, LawPart::rest_rise},
    std::pair{kBristleStiffnessRow.name, LawPart::bristle},
};

}  // namespace

LawPart PartOf(std::string_view name) {
  const auto found = std::ranges::find(kParts, name, [](const auto& part) { return part.first; });
  return found == kParts.end() ? LawPart::other : found->second;
}

std::optional<size_t> PlaceOf(LawPart part, const Law& law) {
  const auto found = std::ranges::find(law.parameters, part,
                                       [](const ParameterInfo& info) { return PartOf(info.name); });
  if (found == law.parameters.end()) return std::nullopt;
  return static_cast<size_t>(found - law.parameters.begin());
}

}  // namespace warmjoint::inline models
