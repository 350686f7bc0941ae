// Friction of one joint from step to step: law, bristle and heat together.
#pragma once

#include <vector>

#include "models/friction/bristle.h"
#include "models/friction/friction_description.h"
#include "models/friction/law.h"
#include "models/friction/thermal.h"

namespace warmjoint {

/// What one joint's friction remembers.
struct FrictionState {
  double bristle = 0;  // load that the bristle carries, N.m or N
  double energy = 0;   // E, N.m or N
};

/// What one step of friction yields.
struct FrictionStep {
  double force = 0;           // F, N.m or N; acts against the motion as -F
  double loss = 0;            // W, W
  bool feeds_itself = false;  // the sliding force of Eq. (20) would push; 0 was used instead
  FrictionState next;
};

/// Steps F = kv v + bristle, whose level on the side of motion is that of Eq. (20):
///   L(side) = side (Fn(side |v|) - kv side |v|) + E.
/// Sliding, F is Eq. (20) exactly and W = |F v| (19); at rest the bristle holds and W = 0.
/// E takes the exact zero-order-hold step (22) and does not see the loss of its own step.
class JointFriction {
 public:
  /// friction: checked (CheckFriction).
  explicit JointFriction(const FrictionDescription& friction);

  /// Sets the step, s. Must precede Step; costs an exponential.
  void SetTimestep(double h);
  double timestep() const { return h_; }

  /// Slope of the force over speed that no bristle bounds, N.m.s/rad or N.s/m.
  double viscous() const { return viscous_; }

  /// The largest load that a cold joint holds at rest, N.m or N.
  double HoldingLevel() const { return std::max(Level(1, 0, 0), Level(-1, 0, 0)); }

  /// One step at velocity v (rad/s or m/s) of a joint with effective inertia M (kg.m^2 or kg).
  FrictionStep Step(const FrictionState& state, double v, double inertia) const;

  /// The force of steady sliding at v != 0, Eq. (20), N.m or N.
  double SlidingForce(double v, double energy) const {
    return WarmForce(v, law_.force(v, values_.data()), energy);
  }

 private:
  double Level(int side, double speed, double energy) const;

  Law law_;
  std::vector<double> values_;  // of the law's table
  double viscous_ = 0;
  bool warms_ = false;
  Thermal thermal_;
  DiscreteThermal discrete_;
  double h_ = 0;
};

}  // namespace warmjoint
