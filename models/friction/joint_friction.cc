#include "models/friction/joint_friction.h"

#include <cmath>

namespace warmjoint {

JointFriction::JointFriction(const FrictionDescription& friction)
    : law_(*FindLaw(friction.law)),
      values_(LawValues(friction)),
      warms_(friction.thermal.has_value()),
      thermal_(friction.thermal.value_or(Thermal{})) {
  const auto found = friction.parameters.find("viscous");
  if (found != friction.parameters.end()) viscous_ = found->second;
}

void JointFriction::SetTimestep(double h) {
  h_ = h;
  discrete_ = Discretise(thermal_, h);
}

double JointFriction::Level(int side, double speed, double energy) const {
  // at rest the law's limit for v -> 0 on that side
  const double v = std::max(speed, std::numeric_limits<double>::min());
  return side * law_.force(side * v, values_.data()) - viscous_ * speed + energy;
}

FrictionStep JointFriction::Step(const FrictionState& state, double v, double inertia) const {
  const double speed = std::abs(v);
  const auto level = [&](int side) { return Level(side, speed, state.energy); };
  Bristle spring = MakeBristle(inertia, h_);
  spring.damping = std::max(0.0, spring.damping - viscous_);  // the slope damps already
  const BristleStep bristle = StepBristle(spring, state.bristle, v, h_, level);

  // a level below zero takes from the viscous force, at most all of it
  FrictionStep step;
  step.force = viscous_ * v + bristle.force;
  const double deficit = bristle.force == 0 && v != 0 ? std::min(0.0, level(Sign(v))) : 0.0;
  if (deficit < 0) {
    step.feeds_itself = viscous_ * speed + deficit < 0;
    step.force = Sign(v) * std::max(0.0, viscous_ * speed + deficit);
  }

  // only what slides gets warm
  step.loss = bristle.sliding || bristle.force == 0 ? Loss(v, step.force) : viscous_ * v * v;
  step.next.bristle = bristle.load;
  step.next.energy =
      warms_ ? ThermalStep(discrete_.gain, discrete_.pole, state.energy, step.loss) : state.energy;
  return step;
}

}  // namespace warmjoint
