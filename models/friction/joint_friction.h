// Friction of one joint from step to step: law, bristle, maps and heat together.
#pragma once

#include <warmjoint/friction.h>
#include <warmjoint/friction_model.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "models/friction/bristle.h"
#include "models/friction/level_terms.h"
#include "models/friction/thermal.h"

namespace warmjoint {

/// One member of the state: its name for people, and where it is.
struct StateMember {
  std::string_view name;
  double FrictionState::*value;
};

/// The members of the state that a friction needs, in the order of mjData.act: bristle load and
/// energy always, second energy for two stages of warming, slip for laws that break away.
std::vector<StateMember> StateOf(const Friction& friction);

/// Steps F = (kv + b E) v + bristle, whose level on the side of motion is
///   L(side) = g(side, |v|) + E + c |load| + maps (LevelTerms),   E = E1 + E2.
/// Sliding, F is Eq. (20) with maps exactly and W = |F v| (19); at rest the bristle holds, W = 0.
/// E takes the exact zero-order-hold step (22) and does not see the loss of its own step.
/// Copies share their maps.
class JointFriction {
 public:
  /// friction: checked (CheckFriction).
  explicit JointFriction(const Friction& friction);

  /// Sets the step, s. Must precede Step; costs exponentials.
  void SetTimestep(double h);

  /// Slope of a cold joint's force over speed, at most, N.m.s/rad or N.s/m: kv and the maps'.
  double SteepestSlope() const { return viscous_ + terms_->SteepestSlope(); }

  /// Slope of a cold joint's force over speed without the maps', and its change with the heat:
  /// kv, N.m.s/rad or N.s/m, and b, s/rad or s/m. At E the slope is max(0, kv + b E), (27).
  double viscous() const { return viscous_; }
  double viscous_per_energy() const { return per_energy_; }

  /// The step of the energies, for the timestep that was set.
  const Heat& heat() const { return heat_; }

  /// The law's own level at rest to a side, 1 or -1, N.m or N, without heat, load and maps; where
  /// level_follows_heat_alone, Level is that plus E wherever and however fast the joint moves.
  double OwnLevelAtRest(int side) const { return level_(false, side, 0, values_.data()); }
  bool level_follows_heat_alone() const { return same_at_any_speed_ && !has_terms_ && !slips_; }

  /// The law's own bristle; none where the step chooses it (UnitBristle).
  const std::optional<Bristle>& own_bristle() const { return own_bristle_; }

  /// The members of the state that it needs (StateOf).
  const std::vector<StateMember>& state() const { return state_; }

  /// Change of the level for each K, N.m/K or N/K; 0 where there is no temperature.
  double level_per_temperature() const { return friction_.level_per_temperature; }

  /// The place of a number that SetNumber sets: a parameter of the law, thermal_gain,
  /// thermal_time_constant, the same with second_ before them, level_per_temperature, load_gain or
  /// viscous_per_energy; nothing where this friction has no such number.
  std::optional<size_t> FindNumber(std::string_view name) const;

  /// The names of all numbers that this friction has, in the order of their places.
  std::vector<std::string> NumberNames() const;

  /// A number as it is set, and what it may be set to.
  double Number(size_t place) const;
  Bounds NumberBounds(size_t place) const;

  /// Sets a number from now on; false, and nothing changed, where it is out of its bounds.
  bool SetNumber(size_t place, double value);

  /// The state that an engine holds in the order of state(); a number that is not finite counts as
  /// 0, so that it does not stay. values: [state().size()].
  FrictionState Load(const double* values) const;

  /// The inverse. values: [state().size()].
  void Store(const FrictionState& state, double* values) const;

  /// The largest load that a cold joint holds at rest, at most, N.m or N; without load_gain's part.
  double HoldingLevel() const;

  /// A joint by itself, whose bristle follows from its effective inertia.
  FrictionStep Step(const FrictionState& state, const JointMotion& motion) const;

  /// L on one side of motion, 1 or -1, N.m or N; below 0 where friction would push.
  double Level(int side, const FrictionState& state, const JointMotion& motion) const;

  /// The rest of a step whose bristle is known, of a law without a bristle of its own.
  FrictionStep Complete(const FrictionState& state, const JointMotion& motion,
                        const BristleStep& bristle) const;

  /// The force of steady sliding at v != 0, Eq. (20) with maps, N.m or N; pushes where the level
  /// is below 0. v: rad/s or m/s.
  double SlidingForce(double v, const JointPlace& place) const;

  /// The same of a joint whose law is known to be L, as the compiler sees it.
  template <typename L>
  double SlidingForceBy(double v, const JointPlace& place) const {
    return WithAdded(L::Force(v, values_.data()), v, place);
  }

  /// What heat, load and maps add to the law's level on one side of motion, N.m or N, and what heat
  /// adds to its slope, N.m.s/rad or N.s/m. side: 1 or -1; speed: |v|, rad/s or m/s.
  double AddedLevel(int side, double speed, const JointPlace& place) const {
    return has_terms_ ? place.energy + TermsAt(side, speed, place) : place.energy;
  }
  double SlopeChange(double energy) const {
    return per_energy_ == 0 ? 0 : Slope(energy) - viscous_;
  }

  /// The law's values in the order of its table.
  const std::vector<double>& values() const { return values_; }

 private:
  FrictionStep Complete(const FrictionState& state, const JointMotion& motion,
                        const BristleStep& bristle, double loss) const;
  void TakeDeficit(const FrictionState& state, const JointMotion& motion, FrictionStep& step) const;
  void Derive();
  /// What load and maps add to the level.
  double TermsAt(int side, double speed, const JointPlace& place) const {
    const double of_load = load_gain_ * std::abs(place.load);
    return terms_->empty() ? of_load : of_load + terms_->At(side, speed, place);
  }
  double Slope(double energy) const { return std::max(0.0, viscous_ + per_energy_ * energy); }
  /// law: the law's own force at v.
  double WithAdded(double law, double v, const JointPlace& place) const {
    const int side = Sign(v);
    return law + SlopeChange(place.energy) * v + side * AddedLevel(side, std::abs(v), place);
  }

  // what Level reads stands first, side by side
  std::vector<double> values_;  // of the law's table
  /// The law's level to a side, held or sliding, at a speed.
  double (*level_)(bool sliding, int side, double speed, const double* p) = nullptr;
  std::shared_ptr<const LevelTerms> terms_;
  bool has_terms_;  // load or maps
  bool same_at_any_speed_ = false;
  bool second_stage_ = false;           // the third state is the second energy
  bool slips_ = false;                  // the last state is the slip
  double holding_[2]{}, sliding_[2]{};  // to sides -1 and 1, where it is the same at any speed
  double load_gain_ = 0;
  double viscous_ = 0;
  double per_energy_ = 0;
  double h_ = 0;

  Friction friction_;  // without its maps
  Law law_;
  std::vector<StateMember> state_;
  std::vector<size_t> others_;  // the numbers beside the law's own that this friction has
  std::optional<Bristle> own_bristle_;
  Heat heat_;
  Bristle unit_;  // of an effective inertia of 1
};

inline double JointFriction::Level(int side, const FrictionState& state,
                                   const JointMotion& motion) const {
  const double energy = state.energy + state.second_energy;
  const bool slides = slips_ && side * motion.velocity > 0 && side * state.slip > 0.5;
  double level = same_at_any_speed_
                     ? (slides ? sliding_ : holding_)[side > 0]
                     : level_(slides, side, std::abs(motion.velocity), values_.data());
  level += energy;
  if (has_terms_) {
    level += TermsAt(side, std::abs(motion.velocity), {motion.position, energy, motion.load});
  }
  return level;
}

inline FrictionStep JointFriction::Complete(const FrictionState& state, const JointMotion& motion,
                                            const BristleStep& bristle) const {
  // only what slides gets warm
  return Complete(state, motion, bristle,
                  bristle.sliding ? Loss(motion.velocity, bristle.force) : 0.0);
}

inline FrictionStep JointFriction::Complete(const FrictionState& state, const JointMotion& motion,
                                            const BristleStep& bristle, double loss) const {
  const double v = motion.velocity;
  const double viscous = Slope(state.energy + state.second_energy) * v;
  FrictionStep step;
  step.next.slip = bristle.sliding ? Sign(v) : 0;
  step.loss = viscous * v + loss;
  step.force = viscous + bristle.force;
  step.sliding = bristle.sliding;

  if (bristle.force == 0 && v != 0) [[unlikely]]
    TakeDeficit(state, motion, step);
  step.next.bristle = bristle.load;
  const Heating by{step.loss, motion.ambient_rise, v};
  step.next.energy = heat_.First(state.energy, by);
  step.next.second_energy = heat_.Second(state.second_energy, by);
  return step;
}

inline FrictionState JointFriction::Load(const double* values) const {
  FrictionState state{values[0], values[1]};
  values += 2;
  if (second_stage_) state.second_energy = *values++;
  if (slips_) state.slip = *values;

  // a sum is finite only where all of its terms are
  const double sum = state.bristle + state.energy + state.second_energy + state.slip;
  if (sum - sum != 0) [[unlikely]] {
    const auto finite = [](double& value) { value = value - value == 0 ? value : 0; };
    finite(state.bristle), finite(state.energy), finite(state.second_energy), finite(state.slip);
  }
  return state;
}

inline void JointFriction::Store(const FrictionState& state, double* values) const {
  *values++ = state.bristle;
  *values++ = state.energy;
  if (second_stage_) *values++ = state.second_energy;
  if (slips_) *values = state.slip;
}

}  // namespace warmjoint
