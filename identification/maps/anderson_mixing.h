// Rounds that converge slowly, taken together.
#pragma once

#include <Eigen/Core>
#include <deque>

namespace warmjoint {

/// A fixed point x = g(x), by Anderson's method (J. ACM 12, 1965): the step is the combination of the
/// latest four rounds whose residual g(x) - x is the smallest in squares.
class AndersonMixing {
 public:
  /// Where to go on. x, g: [N] the point of this round, and g(x).
  Eigen::VectorXd Next(const Eigen::VectorXd& x, const Eigen::VectorXd& g);

 private:
  struct Round {
    Eigen::VectorXd residual;  // [N] g(x) - x
    Eigen::VectorXd image;     // [N] g(x)
  };
  std::deque<Round> rounds_;
};

}  // namespace warmjoint
