#include "sim/plugin/inverse_columns.h"

#include <algorithm>

namespace warmjoint::inline sim {

InverseColumns::InverseColumns(size_t size) : pairs_((size + 1) / 2) {
  solved_.assign(2 * pairs_, Two::Zero());
  columns_.assign(kMost * pairs_, Two::Zero());
}

void InverseColumns::Start(const InertiaBlock& inertia, const mjData* d, Rows rows, int likely) {
  const size_t pairs = pairs_;
  // M^-1 of the levels and of the likely joint, in one go
  Two* const solved = solved_.data();
  for (size_t k = 0; k < pairs; ++k) {
    const Two force = rows.pair(k)[kFriction];
    solved[2 * k] = {force[0], 0};
    solved[2 * k + 1] = {force[1], 0};
  }
  solved[likely][1] = 1;
  inertia.Solve(d, solved);
  count_ = 0;
  likely_ = likely;
}

bool InverseColumns::Add(const InertiaBlock& inertia, const mjData* d,
                         std::span<const int> joints) {
  const auto count = static_cast<int>(joints.size());
  if (count_ + count > kMost) return false;
  // two columns at a time
  for (int n = 0; n < count; n += 2) {
    std::fill(solved_.begin(), solved_.end(), Two::Zero());
    const int lanes = std::min(2, count - n);
    for (int lane = 0; lane < lanes; ++lane) solved_[joints[n + lane]][lane] = 1;
    inertia.Solve(d, solved_.data());
    for (int lane = 0; lane < lanes; ++lane) Keep(joints[n + lane], lane);
  }
  return true;
}

void InverseColumns::Keep(int joint, int lane) {
  const size_t pairs = pairs_;
  const Two* const solved = solved_.data();
  Two* const column = columns_.data() + count_ * pairs;
  for (size_t k = 0; k < pairs; ++k) {
    column[k] = {solved[2 * k][lane], solved[2 * k + 1][lane]};
  }
  joints_[count_++] = joint;
}

}  // namespace warmjoint::inline sim
