#include "models/friction/joint_friction.h"

#include <cmath>

#include "models/friction/law_list.h"
#include "models/friction/lugre_bristle.h"

namespace warmjoint {
namespace {

/// What a bristle lost during a step, W: what it took less what it stores.
double BristleLoss(const Bristle& bristle, double load, const BristleStep& step, double v,
                   double h) {
  const double stored = (step.load - load) * (step.load + load) / (2 * bristle.stiffness * h);
  return std::max(0.0, step.force * v - stored);
}

double ValueOf(const FrictionDescription& friction, const char* name) {
  const auto found = friction.parameters.find(name);
  return found == friction.parameters.end() ? 0 : found->second;
}

}  // namespace

std::vector<StateMember> StateOf(const FrictionDescription& friction) {
  std::vector<StateMember> members{{"bristle load", &FrictionState::bristle},
                                   {"energy", &FrictionState::energy}};
  if (FindLaw(friction.law)->pre_sliding == PreSliding::breakaway) {
    members.push_back({"slip", &FrictionState::slip});
  }
  return members;
}

JointFriction::JointFriction(const FrictionDescription& friction)
    : law_(*FindLaw(friction.law)),
      values_(LawValues(friction)),
      state_(StateOf(friction)),
      viscous_(ValueOf(friction, "viscous")),
      warms_(friction.thermal.has_value()),
      thermal_(friction.thermal.value_or(Thermal{})) {
  if (law_.pre_sliding == PreSliding::bristle) {
    own_bristle_ =
        Bristle{ValueOf(friction, "bristle_stiffness"), ValueOf(friction, "bristle_damping")};
  }
  ChooseStep(AllLaws{});
}

template <typename... L>
void JointFriction::ChooseStep(LawList<L...>) {
  ((law_.name == L::name ? step_ = &StepOf<L> : nullptr), ...);
}

void JointFriction::SetTimestep(double h) {
  h_ = h;
  discrete_ = Discretise(thermal_, h);
}

double JointFriction::HoldingLevel() const {
  return std::max(law_.holding_level(1, values_.data()), law_.holding_level(-1, values_.data()));
}

template <typename L>
FrictionStep JointFriction::StepOf(const JointFriction& joint, const FrictionState& state, double v,
                                   double inertia) {
  const double speed = std::abs(v);
  const double h = joint.h_;
  const bool slips = state.slip * Sign(v) > 0.5;
  const auto level = [&](int side) {
    const double* p = joint.values_.data();
    const bool slides = slips && side * v > 0;
    return (slides ? L::Level(side, speed, p) : HoldingLevelOf<L>(side, speed, p)) + state.energy;
  };

  // held by a bristle: the law's own, or one that the step chooses; the slope damps already
  BristleStep bristle;
  FrictionStep step;
  if constexpr (L::pre_sliding == PreSliding::bristle) {
    const Bristle own = LimitBristle(*joint.own_bristle_, inertia, h);
    bristle = StepLugreBristle(own, state.bristle, v, h, level);
    step.loss = joint.viscous_ * v * v + BristleLoss(own, state.bristle, bristle, v, h);
  } else {
    Bristle spring = MakeBristle(inertia, h);
    spring.damping = std::max(0.0, spring.damping - joint.viscous_);
    bristle = StepBristle(spring, state.bristle, v, h, level);
    step.next.slip = bristle.sliding ? Sign(v) : 0;
  }

  // a level below zero takes from the viscous force, at most all of it
  step.force = joint.viscous_ * v + bristle.force;
  const double deficit = bristle.force == 0 && v != 0 ? std::min(0.0, level(Sign(v))) : 0.0;
  if (deficit < 0) {
    step.feeds_itself = joint.viscous_ * speed + deficit < 0;
    step.force = Sign(v) * std::max(0.0, joint.viscous_ * speed + deficit);
  }

  // only what slides gets warm
  if (L::pre_sliding != PreSliding::bristle || deficit < 0) {
    const bool slides = bristle.sliding || bristle.force == 0;
    step.loss = slides ? Loss(v, step.force) : joint.viscous_ * v * v;
  }
  step.next.bristle = bristle.load;
  step.next.energy = joint.warms_ ? ThermalStep(joint.discrete_.gain, joint.discrete_.pole,
                                                state.energy, step.loss)
                                  : state.energy;
  return step;
}

}  // namespace warmjoint
