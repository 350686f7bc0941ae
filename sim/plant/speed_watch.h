// Whether a driven joint moves as fast as it is told.
#pragma once

#include <cmath>

namespace warmjoint::inline sim {

/// Counts, over equal steps, how often the joint moves within 5 % of a constant commanded speed.
class SpeedWatch {
 public:
  /// A step. wanted, velocity: rad/s or m/s; constant: whether the commanded speed stays as it is.
  void Look(double wanted, double velocity, bool constant) {
    if (!constant || wanted == 0) return;
    ++commanded_;
    reached_ += std::abs(velocity - wanted) <= 0.05 * std::abs(wanted);
  }

  /// Of the steps at a constant speed other than 0; 1 where there were none.
  double share() const {
    return commanded_ == 0 ? 1 : static_cast<double>(reached_) / static_cast<double>(commanded_);
  }

 private:
  long commanded_ = 0;
  long reached_ = 0;
};

}  // namespace warmjoint::inline sim
