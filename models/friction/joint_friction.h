// Friction of one joint from step to step: law, bristle and heat together.
#pragma once

#include <string_view>
#include <vector>

#include "models/friction/bristle.h"
#include "models/friction/friction_description.h"
#include "models/friction/law.h"
#include "models/friction/thermal.h"

namespace warmjoint {

template <typename... L>
struct LawList;

/// What one joint's friction remembers.
struct FrictionState {
  double bristle = 0;  // load that the bristle carries, N.m or N
  double energy = 0;   // E, N.m or N
  double slip = 0;     // -1, 0 or 1: direction in which a joint that broke away slides
};

/// One member of the state: its name for people, and where it is.
struct StateMember {
  std::string_view name;
  double FrictionState::*value;
};

/// The members of the state that a friction needs, in the order of mjData.act: bristle and energy
/// always, slip for laws that break away.
std::vector<StateMember> StateOf(const FrictionDescription& friction);

/// What one step of friction yields.
struct FrictionStep {
  double force = 0;           // F, N.m or N; acts against the motion as -F
  double loss = 0;            // W, W
  bool feeds_itself = false;  // the sliding force of Eq. (20) would push; 0 was used instead
  FrictionState next;
};

/// Steps F = kv v + bristle, whose level on the side of motion is that of Eq. (20):
///   L(side) = g(side, |v|) + E.
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

  /// The law's own bristle; none where the step chooses it (MakeBristle).
  const std::optional<Bristle>& own_bristle() const { return own_bristle_; }

  /// The members of the state that it needs (StateOf).
  const std::vector<StateMember>& state() const { return state_; }

  /// The largest load that a cold joint holds at rest, N.m or N.
  double HoldingLevel() const;

  /// One step at velocity v (rad/s or m/s) of a joint with effective inertia M (kg.m^2 or kg).
  FrictionStep Step(const FrictionState& state, double v, double inertia) const {
    return step_(*this, state, v, inertia);
  }

  /// The force of steady sliding at v != 0, Eq. (20), N.m or N.
  double SlidingForce(double v, double energy) const {
    return WarmForce(v, law_.force(v, values_.data()), energy);
  }

 private:
  template <typename L>
  static FrictionStep StepOf(const JointFriction& joint, const FrictionState& state, double v,
                             double inertia);
  template <typename... L>
  void ChooseStep(LawList<L...>);

  Law law_;
  std::vector<double> values_;  // of the law's table
  std::vector<StateMember> state_;
  double viscous_ = 0;
  std::optional<Bristle> own_bristle_;
  bool warms_ = false;
  Thermal thermal_;
  DiscreteThermal discrete_;
  double h_ = 0;
  FrictionStep (*step_)(const JointFriction&, const FrictionState&, double, double) = nullptr;
};

}  // namespace warmjoint
