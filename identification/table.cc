#include "identification/table.h"

#include <algorithm>

namespace warmjoint {

double* Unknown::PlaceIn(Friction& friction) const {
  switch (role) {
    case Role::law:
      return &friction.parameters[name];
    case Role::load:
      return &friction.load_gain;
    case Role::gain:
      return friction.thermal ? &friction.thermal->gain : nullptr;
    case Role::time_constant:
      return friction.thermal ? &friction.thermal->time_constant : nullptr;
    default:
      return nullptr;
  }
}

std::vector<Unknown> Unnamed(Role role, Eigen::Index count) {
  Unknown row;
  row.role = role;
  return std::vector<Unknown>(static_cast<size_t>(count), row);
}

Slice SliceOf(Role role, const std::vector<Unknown>& table) {
  const auto first = std::ranges::find(table, role, &Unknown::role);
  const auto last =
      std::find_if(first, table.end(), [&](const Unknown& row) { return row.role != role; });
  return {first - table.begin(), last - first};
}

}  // namespace warmjoint
