// A few joints that are held while all the others of their tree slide.
#pragma once

#include <mujoco/mujoco.h>

#include <array>
#include <vector>

#include "sim/plugin/inertia_block.h"
#include "sim/plugin/row_pairs.h"

namespace warmjoint::inline sim {

/// Forces that hold a few joints, by the engine's factors of the whole inertia matrix M. Where all
/// slide by `slip` under their levels, and c_k is M^-1's column of the held joint k,
///   slip + sum_k c_k e_k = 0 at each k
/// tells what each held one's force lacks to its level, e_k.
class FewHeld {
 public:
  /// So many may be held before a block of M is factorised instead.
  static constexpr int kMost = 3;

  FewHeld() = default;
  explicit FewHeld(size_t size) : solved_(size, Two::Zero()), other_(size, Two::Zero()) {}

  /// The joints that may have to be held; slow_count goes on counting beyond kMost.
  void Clear() { slow_count_ = 0; }
  void Add(int joint) {
    if (slow_count_ < kMost) slow_[slow_count_] = joint;
    ++slow_count_;
  }
  int slow_count() const { return slow_count_; }

  /// M^-1 level, and the columns of the slow ones. level: N.m or N, 0 without friction.
  void Solve(const InertiaBlock& inertia, const mjData* d, const double* level, double* bearing);

  /// Holds the slow ones that would slide against their side. side: 1, -1, or 0 without friction;
  /// slip: of all. Returns how many those are.
  int Choose(const signed char* side, const double* slip);

  /// Holds them: lets `slip` be what is left of it, and friction the held ones' forces. level: on
  /// the sides, N.m or N. False where a joint would slide against its side, or a force be out of
  /// its bounds.
  bool Hold(Rows rows, const signed char* side, const double* level, double* slip) const;

  int count() const { return count_; }
  int held(int n) const { return slow_[held_[n]]; }

 private:
  /// What the held forces lack to their levels.
  std::array<double, kMost> Lack(const double* slip) const;

  /// M^-1's column of a slow joint.
  double Column(int n, int row) const { return n == 0 ? solved_[row][1] : other_[row][n - 1]; }

  int slow_count_ = 0, count_ = 0;
  std::array<int, kMost> slow_{}, held_{};
  std::vector<Two> solved_, other_;  // {M^-1 level, column}, {column, column}
};

}  // namespace warmjoint::inline sim
