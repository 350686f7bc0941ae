#include "sim/plugin/joint_rows.h"

#include "sim/plugin/stability.h"

namespace warmjoint {

JointRows::JointRows(const mjModel* m, const std::vector<BoundJoint>& joints) {
  // joints that the inertia matrix couples, apart from those with a bristle of their own
  std::vector<CoupledJoint> coupled;
  std::vector<bool> is_coupled(joints.size());
  for (size_t i = 0; i < joints.size(); ++i) {
    const BoundJoint& joint = joints[i];
    const double inertia = EffectiveInertia(m, joint.dof);
    // before the compiler knows the inertia, nothing is held
    is_coupled[i] = !joint.friction.own_bristle() && inertia > 0;
    if (!is_coupled[i]) continue;
    coupled.push_back(
        {joint.dof, inertia, joint.instances, !joint.friction.level_follows_heat_alone()});
  }
  bristles_ = CoupledBristles(m, coupled);

  // rows of trees first, then a row for each joint that stands alone
  size_t rows = bristles_.size();
  joint_at_.assign(rows, 0);
  std::vector<size_t> places;
  for (size_t i = 0; i < joints.size(); ++i) {
    const size_t row = is_coupled[i] ? bristles_.RowOf(joints[i].dof) : rows++;
    places.push_back(PlaceOf(row));
    if (is_coupled[i]) joint_at_[row] = i;
    if (joints[i].friction.own_bristle()) alone_.push_back(i);
  }
  states_ = JointStates(joints, places);
  // a row is absent until a coupled joint has it
  numbers_.assign(NumbersOf(rows), 0);
  for (size_t row = 0; row < rows + rows % 2; ++row) numbers_[PlaceOf(row) + 2 * kAbsent] = 1;
  for (const CoupledJoint& joint : coupled) {
    const size_t i = joint_at_[bristles_.RowOf(joint.dof)];
    Of(i, kInertia) = joint.inertia;
    Of(i, kPerInertia) = 1 / joint.inertia;
    Of(i, kAbsent) = 0;
  }
  pushed_.reserve(joints.size());
}

void JointRows::ReadNumbers(const mjModel* m, const std::vector<BoundJoint>& joints) {
  // the numbers of each joint's friction, as they are now
  for (size_t i = 0; i < joints.size(); ++i) {
    const JointFriction& friction = joints[i].friction;
    Of(i, kUpperAtRest) = friction.OwnLevelAtRest(1);
    Of(i, kLowerAtRest) = friction.OwnLevelAtRest(-1);
    Of(i, kViscous) = friction.viscous();
    Of(i, kDamping) = joints[i].damping;
    Of(i, kPerEnergy) = friction.viscous_per_energy();
    Of(i, kPole) = friction.heat().first.pole;
    Of(i, kGain) = friction.heat().first.gain;
  }

  // what no joint has need not be worked out
  slopes_change_ = false, have_one_stage_ = true;
  for (size_t i = 0; i < joints.size(); ++i) {
    slopes_change_ = slopes_change_ || Of(i, kPerEnergy) != 0;
    have_one_stage_ = have_one_stage_ && joints[i].friction.heat().IsOneStage();
  }
  SetSlopes();
  const double damping = m->opt.integrator == mjINT_RK4 ? kDampingOfStages : 1;
  const auto of = [&](int dof) -> const BoundJoint& {
    return joints[joint_at_[bristles_.RowOf(dof)]];
  };
  const auto slope = [&](int dof) { return ExplicitSlope(m, {of(dof).friction, of(dof).viscous}); };
  bristles_.SetTimestep(m->opt.timestep, damping, slope, [&](int dof) { return of(dof).drive; });
}

void JointRows::Step(const mjModel* m, const mjtNum* load) {
  load_ = load;
  pushed_.clear();
  // levels, bristles, then what follows of them
  SetLevels();
  if (slopes_change_) SetSlopes();
  bristles_.Step(d_, *this, {numbers_.data()});
  if (!Complete()) [[unlikely]]
    TakeDeficits();
  if (!alone_.empty()) StepAlone(m);
  states_.Store(numbers_.data());
}

/// The levels of joints for which heat alone changes them; of others about those, for a guess.
void JointRows::SetLevels() {
  double* const end = numbers_.data() + numbers_.size();
  for (RowPair row{numbers_.data()}; row.numbers != end; row.numbers += 2 * kColumns) {
    const Two energy = row[kFirst] + row[kSecond];
    row[kUpper] = (row[kUpperAtRest] + energy).max(0);
    row[kLower] = (row[kLowerAtRest] + energy).max(0);
  }
}

/// The slopes over speed at the heat with which the step begins.
void JointRows::SetSlopes() {
  double* const end = numbers_.data() + numbers_.size();
  for (RowPair row{numbers_.data()}; row.numbers != end; row.numbers += 2 * kColumns) {
    const Two energy = row[kFirst] + row[kSecond];
    row[kOwnSlope] = (row[kViscous] + row[kPerEnergy] * energy).max(0) - row[kDamping];
  }
}

/// The level of one side where more than heat changes it.
double JointRows::LevelAt(size_t row, int side) const {
  const size_t i = joint_at_[row];
  FrictionState state;
  if (states_.at()[i].plain) {
    state.energy = Of(i, kFirst);
  } else {
    state = StateOf(i);
  }
  return joints_[i].friction.Level(side, state, MotionOf(i));
}

/// The state with which the step began.
FrictionState JointRows::StateOf(size_t i) const {
  FrictionState state = states_.Before(i);
  state.energy = Of(i, kFirst);
  state.second_energy = Of(i, kSecond);
  return state;
}

JointMotion JointRows::MotionOf(size_t i) const {
  const BoundJoint& joint = joints_[i];
  JointMotion motion;
  motion.position = d_->qpos[joint.position];
  motion.velocity = Of(i, kSpeed);
  if (joint.needs_load) motion.load = load_[joint.dof];
  motion.ambient_rise = Of(i, kRise);
  return motion;
}

/// The rest of each row's step, its bristle being known: JointFriction::Complete for all. False where
/// a joint moves without friction.
bool JointRows::Complete() {
  Two least = Two::Ones();
  double* const end = numbers_.data() + numbers_.size();
  for (RowPair row{numbers_.data()}; row.numbers != end; row.numbers += 2 * kColumns) {
    // loss and heat of the step; friction of 0 in motion is looked at again
    const Two v = row[kSpeed], f = row[kFriction], own = row[kOwnSlope] * v;
    const Two loss = (own + row[kDamping] * v) * v + row[kSliding] * (f * v).abs();
    row[kLoss] = loss;
    row[kForce] = own + f;
    row[kNextFirst] = ThermalStep<Two>(row[kGain], row[kPole], row[kFirst], loss);
    least = least.min(WhereNegative(-v.abs(), f.abs() + row[kAbsent], Two::Ones()));
  }
  if (!have_one_stage_) StepHeats();
  return least[0] != 0 && least[1] != 0;
}

/// The heat of joints that more than the loss changes, or that have two stages.
void JointRows::StepHeats() {
  for (size_t i = 0; i < states_.at().size(); ++i) {
    const Heat& heat = joints_[i].friction.heat();
    const Heating by{Of(i, kLoss), Of(i, kRise), Of(i, kSpeed)};
    Of(i, kNextFirst) = heat.First(Of(i, kFirst), by);
    Of(i, kNextSecond) = heat.Second(Of(i, kSecond), by);
  }
}

/// Joints whose bristle is their own law's.
void JointRows::StepAlone(const mjModel* m) {
  for (const size_t i : alone_) {
    JointMotion motion = MotionOf(i);
    motion.inertia = EffectiveInertia(m, d_, joints_[i].dof);
    Take(i, joints_[i].friction.Step(StateOf(i), motion));
  }
}

void JointRows::Take(size_t i, const FrictionStep& step) {
  Of(i, kForce) = step.force - Of(i, kDamping) * Of(i, kSpeed);
  Of(i, kLoss) = step.loss;
  Of(i, kLoad) = step.next.bristle;
  Of(i, kSliding) = step.sliding;
  Of(i, kNextFirst) = step.next.energy;
  Of(i, kNextSecond) = step.next.second_energy;
  if (step.drives_joint) pushed_.push_back(i);
}

/// Friction without a force may be one that would push.
void JointRows::TakeDeficits() {
  // joints that move without friction, but for those with a bristle of their own
  for (size_t i = 0; i < states_.at().size(); ++i) {
    if (Of(i, kFriction) != 0 || Of(i, kSpeed) == 0) continue;
    if (joints_[i].friction.own_bristle()) continue;
    const BristleStep bristle{0, Of(i, kLoad), Of(i, kSliding) != 0};
    Take(i, joints_[i].friction.Complete(StateOf(i), MotionOf(i), bristle));
  }
}

}  // namespace warmjoint
