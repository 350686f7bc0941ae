#include "models/friction/joint_friction.h"

#include <array>
#include <cmath>
#include <span>

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

/// A number beside the law's own that may be set, and where it is; null where it is not given.
struct OtherNumber {
  std::string_view name;
  const ParameterInfo& info;
  double* (*find)(FrictionDescription& friction);
};

std::span<const OtherNumber> OtherNumbers() {
  using Friction = FrictionDescription;
  static const std::array numbers{
      OtherNumber{"thermal_gain", Thermal::parameters[0],
                  [](Friction& f) { return f.thermal ? &f.thermal->gain : nullptr; }},
      OtherNumber{"thermal_time_constant", Thermal::parameters[1],
                  [](Friction& f) { return f.thermal ? &f.thermal->time_constant : nullptr; }},
      OtherNumber{"second_thermal_gain", Thermal::parameters[0],
                  [](Friction& f) { return f.second_thermal ? &f.second_thermal->gain : nullptr; }},
      OtherNumber{"second_thermal_time_constant", Thermal::parameters[1],
                  [](Friction& f) {
                    return f.second_thermal ? &f.second_thermal->time_constant : nullptr;
                  }},
      OtherNumber{"level_per_temperature", FrictionOptions()[0].info,
                  [](Friction& f) {
                    return f.level_per_temperature != 0 ? &f.level_per_temperature : nullptr;
                  }},
      OtherNumber{"viscous_per_energy", FrictionOptions()[1].info,
                  [](Friction& f) { return f.thermal ? &f.viscous_per_energy : nullptr; }},
  };
  return numbers;
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
      has_terms_(!terms_->empty()) {
  second_stage_ = friction.second_thermal.has_value();
  slips_ = law_.pre_sliding == PreSliding::breakaway;
  friction_.maps.clear();
  ChooseStep(AllLaws{});
  Derive();
}

/// What follows from the law's values and the other numbers, without the step.
void JointFriction::Derive() {
  const auto value = [&](std::string_view name) {
    const auto place = FindNumber(name);
    return place ? values_[*place] : 0;
  };
  viscous_ = value("viscous");
  per_energy_ = friction_.viscous_per_energy;
  if (law_.pre_sliding != PreSliding::bristle) return;
  own_bristle_ = Bristle{value("bristle_stiffness"), value("bristle_damping")};
}

std::optional<size_t> JointFriction::FindNumber(std::string_view name) const {
  for (size_t i = 0; i < law_.parameters.size(); ++i) {
    if (law_.parameters[i].name == name) return i;
  }
  for (size_t i = 0; i < OtherNumbers().size(); ++i) {
    const OtherNumber& number = OtherNumbers()[i];
    if (number.name != name) continue;
    FrictionDescription friction = friction_;
    if (number.find(friction)) return law_.parameters.size() + i;
  }
  return std::nullopt;
}

bool JointFriction::SetNumber(size_t place, double value) {
  const bool own = place < values_.size();
  const OtherNumber* other = own ? nullptr : &OtherNumbers()[place - values_.size()];
  const ParameterInfo& info = own ? law_.parameters[place] : other->info;
  const bool time = info.name == Thermal::parameters[1].name;
  if (!(value >= info.lower && value <= info.upper) || (time && value == 0)) return false;
  if (own) {
    values_[place] = value;
    Derive();
    return true;
  }
  *other->find(friction_) = value;
  per_energy_ = friction_.viscous_per_energy;
  if (h_ > 0) heat_ = DiscretiseHeat(friction_, h_);
  return true;
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
  step.sliding = bristle.sliding;

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
