// How far an iteration is from where it goes.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace warmjoint {

/// Judgement of a sequence that converges linearly, x[i+1] - x* = rate (x[i] - x*).
struct Convergence {
  double rate = 1;       // observed, over the last changes; 1 where none can be seen
  double remaining = 0;  // |x[n] - x*|, extrapolated: |x[n] - x[n-1]| rate / (1 - rate)
};

/// iterates: x[0], x[1], ..., each [d] and divided by its scale, so that 0.01 is 1 %; distances
/// are the largest over the entries. Infinite where the sequence does not approach anything, or is
/// too short (fewer than 3) to tell.
Convergence JudgeConvergence(const std::vector<Eigen::VectorXd>& iterates);

}  // namespace warmjoint
