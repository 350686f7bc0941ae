#include "models/friction/joint_friction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "models/friction/bristle.h"
#include "models/friction/laws.h"
#include "models/friction/parameter_rows.h"
#include "models/friction/thermal.h"

namespace warmjoint {
namespace {

/// What a bristle lost during a step, W: what it took less what it stores.
double BristleLoss(const Bristle& bristle, double load, const BristleStep& step, double v,
                   double h) {
  const double stored = (step.load - load) * (step.load + load) / (2 * bristle.stiffness * h);
  return std::max(0.0, step.force * v - stored);
}

/// A number beside the law's own that may be set where the friction has it.
struct OtherNumber {
  std::string_view prefix;  // before the name of its table
  const ParameterInfo& info;
  bool (*is_given)(const Friction& friction);
  double& (*in)(Friction& friction);
};

/// The row of FrictionOptions for a member.
const ParameterInfo& InfoOf(double Friction::*member) {
  return std::ranges::find(FrictionOptions(), member, &FrictionOption::value)->info;
}

std::span<const OtherNumber> OtherNumbers() {
  using F = Friction;
  constexpr auto& stage = Thermal::parameters;
  constexpr auto warms = [](const F& f) { return f.thermal.has_value(); };
  constexpr auto warms_twice = [](const F& f) { return f.second_thermal.has_value(); };
  static const std::array numbers{
      OtherNumber{"", stage[0], warms, [](F& f) -> double& { return f.thermal->gain; }},
      OtherNumber{"", stage[1], warms, [](F& f) -> double& { return f.thermal->time_constant; }},
      OtherNumber{kSecondStage, stage[0], warms_twice,
                  [](F& f) -> double& { return f.second_thermal->gain; }},
      OtherNumber{kSecondStage, stage[1], warms_twice,
                  [](F& f) -> double& { return f.second_thermal->time_constant; }},
      OtherNumber{"", InfoOf(&F::level_per_temperature),
                  [](const F& f) { return f.level_per_temperature != 0; },
                  [](F& f) -> double& { return f.level_per_temperature; }},
      OtherNumber{"", InfoOf(&F::load_gain), [](const F& f) { return f.load_gain != 0; },
                  [](F& f) -> double& { return f.load_gain; }},
      OtherNumber{"", InfoOf(&F::viscous_per_energy), warms,
                  [](F& f) -> double& { return f.viscous_per_energy; }},
  };
  return numbers;
}

}  // namespace

std::vector<StateMember> StateOf(const Friction& friction) {
  // a second stage and the direction of a slide only where the friction knows them
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

JointFriction::JointFriction(const Friction& friction)
    : values_(LawValues(friction)),
      terms_(std::make_shared<const LevelTerms>(friction)),
      has_terms_(!terms_->empty() || friction.load_gain != 0),
      load_gain_(friction.load_gain),
      friction_(friction),
      law_(*FindLaw(friction.law)),
      state_(StateOf(friction)) {
  second_stage_ = friction.second_thermal.has_value();
  slips_ = law_.pre_sliding == PreSliding::breakaway;
  for (size_t i = 0; i < OtherNumbers().size(); ++i) {
    if (OtherNumbers()[i].is_given(friction)) others_.push_back(i);
  }
  friction_.maps.clear();
  // the levels of the law by this name, compiled for it
  ForLawNamed(AllLaws{}, law_.name, [this]<typename L>() {
    same_at_any_speed_ = LawAtAnySpeed<L>;
    level_ = [](bool sliding, int side, double speed, const double* p) {
      return sliding ? L::Level(side, speed, p) : HoldingLevelOf<L>(side, speed, p);
    };
  });
  Derive();
}

/// What follows from the law's values and the other numbers, without the step.
void JointFriction::Derive() {
  const std::optional<size_t> slope = PlaceOf(LawPart::slope, law_);
  viscous_ = slope ? values_[*slope] : 0;
  per_energy_ = friction_.viscous_per_energy;
  // levels that are the same at any speed are found once
  if (same_at_any_speed_) {
    for (const int side : {-1, 1}) {
      holding_[side > 0] = level_(false, side, 0, values_.data());
      sliding_[side > 0] = level_(true, side, 0, values_.data());
    }
  }
  // the bristle that a law brings
  ForLawNamed(AllLaws{}, law_.name, [this]<typename L>() {
    if constexpr (LawWithBristle<L>) {
      const LawBristle<double> own = L::BristleOf(values_.data());
      own_bristle_ = Bristle{own.stiffness, own.damping};
    }
  });
}

std::optional<size_t> JointFriction::FindNumber(std::string_view name) const {
  const std::vector<std::string> names = NumberNames();
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) return std::nullopt;
  return static_cast<size_t>(found - names.begin());
}

std::vector<std::string> JointFriction::NumberNames() const {
  std::vector<std::string> names;
  for (const ParameterInfo& info : law_.parameters) names.emplace_back(info.name);
  for (const size_t i : others_) {
    const OtherNumber& number = OtherNumbers()[i];
    names.push_back(std::string(number.prefix) + std::string(number.info.name));
  }
  return names;
}

double JointFriction::Number(size_t place) const {
  if (place < values_.size()) return values_[place];
  Friction friction = friction_;
  return OtherNumbers()[others_[place - values_.size()]].in(friction);
}

Bounds JointFriction::NumberBounds(size_t place) const {
  const bool own = place < values_.size();
  const ParameterInfo& info =
      own ? law_.parameters[place] : OtherNumbers()[others_[place - values_.size()]].info;
  // a time constant is above 0, a gain no larger than any joint's
  const auto& [gain, time] = Thermal::parameters;
  if (info.name == time.name) return {.above = 0};
  if (info.name == gain.name) {
    return {.at_least = -kLargestThermalGain, .at_most = kLargestThermalGain};
  }
  return {.at_least = info.lower, .at_most = info.upper};
}

bool JointFriction::SetNumber(size_t place, double value) {
  if (!std::isfinite(value) || !NumberBounds(place).Hold(value)) return false;

  // what follows from the number changes with it
  if (place < values_.size()) {
    values_[place] = value;
    Derive();
    return true;
  }

  // of warming or options: the step of the heat may follow from it
  OtherNumbers()[others_[place - values_.size()]].in(friction_) = value;
  per_energy_ = friction_.viscous_per_energy;
  load_gain_ = friction_.load_gain;
  if (h_ > 0) heat_ = DiscretiseHeat(friction_, h_);
  return true;
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
  return WithAdded(law_.force(v, values_.data()), v, place);
}

/// A level below zero takes from the viscous force, at most all of it.
void JointFriction::TakeDeficit(const FrictionState& state, const JointMotion& motion,
                                FrictionStep& step) const {
  const double v = motion.velocity;
  const double deficit = std::min(0.0, Level(Sign(v), state, motion));
  if (deficit == 0) return;
  // it may take the viscous force to 0, but not turn it
  const double left = std::abs(step.force) + deficit;
  step.drives_joint = left < 0;
  step.force = Sign(v) * std::max(0.0, left);
  step.loss = Loss(v, step.force);
}

FrictionStep JointFriction::Step(const FrictionState& state, const JointMotion& motion) const {
  const double v = motion.velocity;
  const auto level = [&](int side) { return Level(side, state, motion); };
  // the law's own bristle loses what it took less what it stores
  if (own_bristle_) {
    const Bristle own = LimitBristle(*own_bristle_, motion.inertia, h_);
    const BristleStep bristle = StepLugreBristle(own, state.bristle, v, h_, level);
    FrictionStep step =
        Complete(state, motion, bristle, BristleLoss(own, state.bristle, bristle, v, h_));
    step.next.slip = 0;
    return step;
  }
  // the slope damps already
  Bristle spring = ScaleBristle(unit_, motion.inertia);
  spring.damping = std::max(0.0, spring.damping - Slope(state.energy + state.second_energy));
  return Complete(state, motion, StepBristle(spring, state.bristle, v, h_, level));
}

}  // namespace warmjoint
