#include "models/recording/unwrap.h"

#include <cmath>
#include <numbers>

namespace warmjoint::inline models {

int UnwrapTurns(const Eigen::VectorXd& time, const Eigen::VectorXd& velocity,
                Eigen::VectorXd& position) {
  constexpr double turn = 2 * std::numbers::pi;  // rad
  constexpr double slack = 1e-3 * turn;          // sensors round their last step
  if (position.maxCoeff() - position.minCoeff() > turn + slack) return 0;
  return UnwrapRange(time, velocity, turn, position);
}

int UnwrapRange(const Eigen::VectorXd& time, const Eigen::VectorXd& velocity, double range,
                Eigen::VectorXd& position) {
  int jumps = 0;
  double turns = 0;  // added so far, rad or m
  double before = position[0];
  for (Eigen::Index i = 1; i < position.size(); ++i) {
    const double step = position[i] - before;
    before = position[i];
    if (std::abs(step) > range / 2) {
      const double undone = step - std::copysign(range, step);
      const double expected =
          velocity.size() == 0 ? 0 : (velocity[i] + velocity[i - 1]) / 2 * (time[i] - time[i - 1]);
      if (std::abs(undone - expected) < std::abs(step - expected)) {
        turns += undone - step;
        ++jumps;
      }
    }
    position[i] += turns;
  }
  return jumps;
}

}  // namespace warmjoint::inline models
