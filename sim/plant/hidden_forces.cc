#include "sim/plant/hidden_forces.h"

#include <cmath>
#include <numbers>

namespace warmjoint::inline sim {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

double Sign(double v) { return v > 0 ? 1 : v < 0 ? -1 : 0; }

/// What happened since the last change of direction.
class Direction {
 public:
  /// To the next sample. way: gone since the last one, rad or m.
  void Go(double velocity, double way) {
    const double sign = Sign(velocity);
    way_ += std::abs(way);
    // the first motion is no change of direction
    if (sign == 0 || sign == held_) return;
    odd_ = held_ != 0 && !odd_;
    way_ = 0;
    held_ = sign;
  }
  bool odd() const { return odd_; }    // every other hold
  double way() const { return way_; }  // rad or m

 private:
  double held_ = 0;  // sign of the last motion
  double way_ = 0;
  bool odd_ = false;
};

/// Changes of the level that follow time, direction and way, against the motion.
VectorXd Levels(const Disturbances& d, const VectorXd& time, const VectorXd& velocity,
                const VectorXd& position) {
  const Backlash& backlash = d.hidden.backlash;
  const Hysteresis& hysteresis = d.hidden.hysteresis;
  VectorXd levels(time.size());
  Direction direction;
  for (Index i = 0; i < time.size(); ++i) {
    direction.Go(velocity[i], i > 0 ? position[i] - position[i - 1] : 0);
    // of every other hold, then with time, then with the way since the joint turned
    double level = direction.odd() ? d.hold_parity.level : 0;
    if (time[i] >= d.step_in_time.time) level += d.step_in_time.level;
    level += d.run_in.level * std::exp(-time[i] / d.run_in.time_constant);
    if (direction.way() < backlash.way) level -= backlash.level;
    level -= hysteresis.level * std::exp(-direction.way() / hysteresis.way);
    levels[i] = level;
  }
  return levels;
}

/// |v| behind a first-order low-pass, settled on the first sample, less |v|. [N]
VectorXd SpeedBehind(const VectorXd& time, const VectorXd& velocity, double time_constant) {
  const VectorXd speed = velocity.cwiseAbs();
  VectorXd behind = VectorXd::Zero(speed.size());
  double followed = speed.size() > 0 ? speed[0] : 0;
  for (Index i = 1; i < speed.size(); ++i) {
    followed += -std::expm1(-(time[i] - time[i - 1]) / time_constant) * (speed[i - 1] - followed);
    behind[i] = followed - speed[i];
  }
  return behind;
}

/// dv/dt between neighbouring samples, as both see it. [N]
VectorXd Acceleration(const VectorXd& time, const VectorXd& velocity) {
  VectorXd acceleration = VectorXd::Zero(time.size());
  for (Index i = 1; i + 1 < time.size(); ++i) {
    acceleration[i] = (velocity[i + 1] - velocity[i - 1]) / (time[i + 1] - time[i - 1]);
  }
  return acceleration;
}

}  // namespace

VectorXd HiddenTorque(const Disturbances& disturbances, const VectorXd& time,
                      const VectorXd& velocity, const VectorXd& position,
                      const VectorXd& acceleration) {
  const HiddenForces& hidden = disturbances.hidden;
  // along the direction of motion
  VectorXd levels = Levels(disturbances, time, velocity, position);
  if (hidden.memory.slope != 0) {
    levels += hidden.memory.slope * SpeedBehind(time, velocity, hidden.memory.time_constant);
  }
  levels.array() += hidden.quadratic_drag.coefficient * velocity.array().square();
  if (hidden.ripple.amplitude != 0) {
    const double wave = 2 * std::numbers::pi / hidden.ripple.period;
    levels.array() += hidden.ripple.amplitude * (wave * position.array()).sin();
  }

  // what acts whatever the direction
  VectorXd torque = velocity.unaryExpr(&Sign).cwiseProduct(levels);
  torque += hidden.spring.stiffness * position;
  if (hidden.inertia.inertia != 0) {
    const bool known = acceleration.size() > 0;
    torque += hidden.inertia.inertia * (known ? acceleration : Acceleration(time, velocity));
  }
  return torque;
}

}  // namespace warmjoint::inline sim
