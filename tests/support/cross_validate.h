// Cross validation over the parts of a recording, strength by strength: what searches are held to.
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <thread>
#include <vector>

#include "identification/ridge/local_ridge.h"

namespace warmjoint::test {

/// Mean squared errors of held-out parts for each strength. parts: normal equations of contiguous
/// segments of a recording; every part is predicted from all the others. Kernels that never meet
/// cost nothing (local_ridge.h). An error is infinite where the strength is too small to solve.
/// threads: parts that are worked on at once; the result does not depend on it.
inline Eigen::VectorXd CrossValidate(const std::vector<NormalEquations>& parts, Eigen::Index free,
                                     const std::vector<double>& strengths, int threads = 1) {
  NormalEquations all = parts.front();
  for (size_t i = 1; i < parts.size(); ++i) all = all.Plus(parts[i]);

  // each thread takes the next part
  Eigen::MatrixXd squares(strengths.size(), parts.size());
  std::atomic<size_t> next = 0;
  const auto work = [&] {
    for (size_t i = next++; i < parts.size(); i = next++) {
      HeldOutPart part(parts[i], all, free);
      for (size_t k = 0; k < strengths.size(); ++k) squares(k, i) = part.Squares(strengths[k]);
    }
  };
  // the calling thread works, too
  std::vector<std::jthread> helpers;
  for (int i = 1; i < threads; ++i) helpers.emplace_back(work);
  work();
  helpers.clear();
  return squares.rowwise().sum() / static_cast<double>(all.rows);
}

}  // namespace warmjoint::test
