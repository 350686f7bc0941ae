#include "models/friction/law.h"

#include <algorithm>

#include "models/friction/law_list.h"

namespace warmjoint {
namespace {

template <typename L>
Law Describe() {
  return {L::name,
          L::equation,
          L::parameters,
          &L::template Force<double>,
          [](int side, const double* p) { return HoldingLevelOf<L>(side, 0, p); },
          L::pre_sliding};
}

template <typename... L>
std::vector<Law> DescribeAll(LawList<L...>) {
  return {Describe<L>()...};
}

}  // namespace

const std::vector<Law>& Laws() {
  static const std::vector<Law> laws = DescribeAll(AllLaws{});
  return laws;
}

const Law* FindLaw(std::string_view name) {
  for (const Law& law : Laws()) {
    if (law.name == name) return &law;
  }
  return nullptr;
}

std::vector<std::string> LawNames() {
  std::vector<std::string> names;
  for (const Law& law : Laws()) names.emplace_back(law.name);
  return names;
}

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

void Regressor(const Law& law, double v, double* row) {
  std::vector<double> unit(law.parameters.size(), 0.0);
  for (size_t i = 0; i < unit.size(); ++i) {
    unit[i] = 1.0;
    row[i] = law.force(v, unit.data());
    unit[i] = 0.0;
  }
}

}  // namespace warmjoint
