#include "models/friction/joint_friction.h"

#include <cmath>

#include "models/friction/law_list.h"
#include "models/friction/lugre_bristle.h"

namespace warmjoint::inline models {
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
  if (friction.second_thermal) {
    members.push_back({"second energy", &FrictionState::second_energy});
  }
  if (FindLaw(friction.law)->pre_sliding == PreSliding::breakaway) {
    members.push_back({"slip", &FrictionState::slip});
  }
  return members;
}

JointFriction::JointFriction(const FrictionDescription& friction)
    : friction_(friction),
      law_(*FindLaw(friction.law)),
      values_(LawValues(friction)),
      state_(StateOf(friction)),
      terms_(std::make_shared<const LevelTerms>(friction)),
      has_terms_(!terms_->empty()),
      viscous_(ValueOf(friction, "viscous")),
      per_energy_(friction.viscous_per_energy) {
  second_stage_ = friction.second_thermal.has_value();
  slips_ = law_.pre_sliding == PreSliding::breakaway;
  if (law_.pre_sliding == PreSliding::bristle) {
    own_bristle_ =
        Bristle{ValueOf(friction, "bristle_stiffness"), ValueOf(friction, "bristle_damping")};
  }
  friction_.maps.clear();
  ChooseStep(AllLaws{});
}

template <typename... L>
void JointFriction::ChooseStep(LawList<L...>) {
  ((law_.name == L::name ? void(step_ = &StepOf<L>) : void()), ...);
}

void JointFriction::SetTimestep(double h) {
  h_ = h;
  unit_ = UnitBristle(h);
  heat_ = DiscretiseHeat(friction_, h);
}

double JointFriction::HoldingLevel() const {
  const double* p = values_.data();
  return std::max(law_.holding_level(1, p), law_.holding_level(-1, p)) + terms_->LargestAtRest();
}

double JointFriction::SlidingForce(double v, const JointPlace& place) const {
  const int side = Sign(v);
  const double level = AddedLevel(side, std::abs(v), place);
  return law_.force(v, values_.data()) + SlopeChange(place.energy) * v + side * level;
}

/// L on each side of motion, N.m or N.
template <typename L>
struct JointFriction::Level {
  const JointFriction& joint;
  JointPlace place;
  double v;
  bool slips;  // broke away in the direction of v

  double operator()(int side) const {
    const double* p = joint.values_.data();
    const double speed = std::abs(v);
    const bool slides = slips && side * v > 0;
    double level = slides ? L::Level(side, speed, p) : HoldingLevelOf<L>(side, speed, p);
    level += place.energy;
    if (joint.has_terms_) level += joint.terms_->At(side, speed, place);
    return level;
  }
};

template <typename L>
FrictionStep JointFriction::StepOf(const JointFriction& joint, const FrictionState& state,
                                   const JointMotion& motion) {
  const double v = motion.velocity, h = joint.h_;
  const double energy = state.energy + state.second_energy;
  const double viscous = joint.Slope(energy) * v;
  const Level<L> level{
      joint, {motion.position, energy, motion.load}, v, state.slip * Sign(v) > 0.5};

  // held by a bristle: the law's own, or one that the step chooses; the slope damps already
  FrictionStep step;
  BristleStep bristle;
  if constexpr (L::pre_sliding == PreSliding::bristle) {
    const Bristle own = LimitBristle(*joint.own_bristle_, motion.inertia, h);
    bristle = StepLugreBristle(own, state.bristle, v, h, level);
    step.loss = viscous * v + BristleLoss(own, state.bristle, bristle, v, h);
  } else {
    Bristle spring = ScaleBristle(joint.unit_, motion.inertia);
    spring.damping = std::max(0.0, spring.damping - joint.Slope(energy));
    bristle = StepBristle(spring, state.bristle, v, h, level);
    step.next.slip = bristle.sliding ? Sign(v) : 0;
    // only what slides gets warm
    step.loss = viscous * v + (bristle.sliding ? Loss(v, bristle.force) : 0.0);
  }
  step.force = viscous + bristle.force;

  // a level below zero takes from the viscous force, at most all of it
  const double deficit = bristle.force == 0 && v != 0 ? std::min(0.0, level(Sign(v))) : 0.0;
  if (deficit < 0) {
    const double left = std::abs(viscous) + deficit;
    step.feeds_itself = left < 0;
    step.force = Sign(v) * std::max(0.0, left);
    step.loss = Loss(v, step.force);
  }

  step.next.bristle = bristle.load;
  step.next.energy = joint.heat_.First(state.energy, step.loss, motion.ambient_rise);
  step.next.second_energy = joint.heat_.Second(state.second_energy, step.loss);
  return step;
}

}  // namespace warmjoint::inline models
