#include "sim/plugin/few_held.h"

#include <algorithm>

namespace warmjoint::inline sim {

int FewHeld::Choose(const InertiaBlock& inertia, const mjData* d, const signed char* side,
                    const double* slip) {
  count_ = 0;
  for (int n = 0; n < slow_count_; ++n) {
    const int k = slow_[n];
    if (side[k] * slip[k] < 0) held_[count_++] = k;
  }
  for (int n = 0; n < count_; ++n) {
    std::vector<double>& column = column_[n];
    std::fill(column.begin(), column.end(), 0.0);
    column[held_[n]] = 1;
    inertia.Solve(d, column.data());
  }
  return count_;
}

bool FewHeld::Hold(Rows rows, const signed char* side, const double* level, double* slip) const {
  double lack[kMost]{};
  if (count_ == 1) {
    const int k = held_[0];
    lack[0] = -slip[k] / column_[0][k];
  } else if (count_ == 2) {
    const auto [j, k] = held_;
    const double a = column_[0][j], b = column_[1][j], c = column_[1][k];
    lack[0] = (b * slip[k] - c * slip[j]) / (a * c - b * b);
    lack[1] = (b * slip[j] - a * slip[k]) / (a * c - b * b);
  }
  const size_t size = column_[0].size();
  for (int n = 0; n < count_; ++n) {
    const int k = held_[n];
    const Row row = rows.at(PlaceOf(static_cast<size_t>(k)));
    const double force = row[kFriction] = level[k] - lack[n];
    if (!(force <= row[kUpper] && -force <= row[kLower])) return false;
    for (size_t i = 0; i < size; ++i) slip[i] += column_[n][i] * lack[n];
  }
  for (int n = 0; n < count_; ++n) slip[held_[n]] = 0;
  bool right = true;
  for (size_t i = 0; i < size; ++i) right = right && !(side[i] * slip[i] < 0);
  return right;
}

}  // namespace warmjoint::inline sim
