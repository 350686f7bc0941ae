#include "sim/plugin/few_held.h"

#include <algorithm>

namespace warmjoint::inline sim {

void FewHeld::Solve(const InertiaBlock& inertia, const mjData* d, const double* level,
                    double* bearing) {
  const size_t size = solved_.size();
  for (size_t i = 0; i < size; ++i) solved_[i] = {level[i], 0};
  if (slow_count_ > 0) solved_[slow_[0]][1] = 1;
  inertia.Solve(d, solved_.data());
  for (size_t i = 0; i < size; ++i) bearing[i] = solved_[i][0];
  if (slow_count_ < 2) return;
  std::fill(other_.begin(), other_.end(), Two::Zero());
  for (int n = 1; n < std::min(slow_count_, kMost); ++n) other_[slow_[n]][n - 1] = 1;
  inertia.Solve(d, other_.data());
}

int FewHeld::Choose(const signed char* side, const double* slip) {
  count_ = 0;
  for (int n = 0; n < slow_count_; ++n) {
    if (side[slow_[n]] * slip[slow_[n]] < 0) held_[count_++] = n;
  }
  return count_;
}

std::array<double, FewHeld::kMost> FewHeld::Lack(const double* slip) const {
  // the matrix of the held rows of their columns is positive definite, so that no pivot is 0
  double matrix[kMost][kMost];
  std::array<double, kMost> lack{};
  for (int r = 0; r < count_; ++r) {
    for (int c = 0; c < count_; ++c) matrix[r][c] = Column(held_[c], held(r));
    lack[r] = -slip[held(r)];
  }
  for (int p = 0; p < count_; ++p) {
    for (int r = p + 1; r < count_; ++r) {
      const double factor = matrix[r][p] / matrix[p][p];
      for (int c = p + 1; c < count_; ++c) matrix[r][c] -= factor * matrix[p][c];
      lack[r] -= factor * lack[p];
    }
  }
  for (int p = count_ - 1; p >= 0; --p) {
    for (int c = p + 1; c < count_; ++c) lack[p] -= matrix[p][c] * lack[c];
    lack[p] /= matrix[p][p];
  }
  return lack;
}

bool FewHeld::Hold(Rows rows, const signed char* side, const double* level, double* slip) const {
  const std::array<double, kMost> lack = Lack(slip);
  const auto size = static_cast<int>(solved_.size());
  for (int n = 0; n < count_; ++n) {
    const int k = held(n);
    const Row row = rows.at(PlaceOf(static_cast<size_t>(k)));
    const double force = row[kFriction] = level[k] - lack[n];
    if (!(force <= row[kUpper] && -force <= row[kLower])) return false;
    for (int i = 0; i < size; ++i) slip[i] += Column(held_[n], i) * lack[n];
  }
  for (int n = 0; n < count_; ++n) slip[held(n)] = 0;
  bool right = true;
  for (int i = 0; i < size; ++i) right = right && !(side[i] * slip[i] < 0);
  return right;
}

}  // namespace warmjoint::inline sim
