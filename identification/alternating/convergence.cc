#include "identification/alternating/convergence.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace warmjoint {
namespace {

constexpr size_t kLastChanges = 5;  // over which the rate is observed
constexpr double kStill = 1e-9;     // a change that the stopping rules inside explain

double Change(const std::vector<Eigen::VectorXd>& iterates, size_t i) {
  return (iterates[i] - iterates[i - 1]).cwiseAbs().maxCoeff();
}

}  // namespace

Convergence JudgeConvergence(const std::vector<Eigen::VectorXd>& iterates) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  if (iterates.size() < 3) return {1, kNever};

  const size_t last = iterates.size() - 1;
  const double change = Change(iterates, last);
  if (change < kStill) return {0, 0};

  // change[n] = rate^m change[n - m]
  const size_t span = std::min(kLastChanges, last - 1);
  const double rate =
      std::pow(change / Change(iterates, last - span), 1.0 / static_cast<double>(span));
  if (!(rate < 1)) return {1, kNever};
  return {rate, change * rate / (1 - rate)};
}

}  // namespace warmjoint
