#include "models/recording/unwrap.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "models/recording/sampling.h"

namespace warmjoint {
namespace {

/// Jumps that were undone, and how many of them lie at a gap of the log.
struct Undone {
  int jumps = 0, at_gaps = 0;
};

Undone Undo(const Eigen::VectorXd& time, const Eigen::VectorXd& velocity, double range,
            Eigen::VectorXd& position) {
  const double longest = LongestStep(time);
  Undone undone;
  double turns = 0;  // added so far, rad or m
  double before = position[0];
  for (Eigen::Index i = 1; i < position.size(); ++i) {
    const double step = position[i] - before, h = time[i] - time[i - 1];
    before = position[i];
    if (std::abs(step) > range / 2) {
      // the speeds beside a gap tell nothing of the way in it
      const bool gap = h > longest;
      const double expected =
          velocity.size() == 0 || gap ? 0 : (velocity[i] + velocity[i - 1]) / 2 * h;
      // a jump is one where the way back fits the speed better than the step itself
      const double back = std::copysign(range, step);
      if (std::abs(step - back - expected) < std::abs(step - expected)) {
        turns -= back;
        ++undone.jumps;
        undone.at_gaps += gap;
      }
    }
    position[i] += turns;
  }
  return undone;
}

}  // namespace

int UnwrapTurns(const Eigen::VectorXd& time, const Eigen::VectorXd& velocity,
                Eigen::VectorXd& position) {
  constexpr double turn = 2 * std::numbers::pi;  // rad
  constexpr double slack = 1e-3 * turn;          // sensors round their last step
  // what spans more than a turn already counts its turns
  if (position.maxCoeff() - position.minCoeff() > turn + slack) return 0;
  Eigen::VectorXd unwrapped = position;
  const Undone undone = Undo(time, velocity, turn, unwrapped);

  // jumps at gaps alone may be motion that was not logged
  if (undone.jumps == undone.at_gaps) return 0;
  position = std::move(unwrapped);
  return undone.jumps;
}

int UnwrapRange(const Eigen::VectorXd& time, const Eigen::VectorXd& velocity, double range,
                Eigen::VectorXd& position) {
  return Undo(time, velocity, range, position).jumps;
}

}  // namespace warmjoint
