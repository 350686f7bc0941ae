// The joints of an instance through one step: a column for each of their numbers.
#pragma once

#include <mujoco/mujoco.h>

#include <array>
#include <vector>

#include "models/friction/joint_friction.h"
#include "sim/plugin/bound_joints.h"
#include "sim/plugin/coupled_bristles.h"
#include "sim/plugin/joint_states.h"

namespace warmjoint {

/// Steps the friction of joints as JointFriction says, with bristles that the inertia matrix
/// couples. A row is a degree of freedom of a tree on which the joints act, or a joint by itself;
/// those without friction hold zeros. Allocates nothing after it was made.
class JointRows : private LevelSource {
 public:
  JointRows() = default;
  JointRows(const mjModel* m, const std::vector<BoundJoint>& joints);

  /// Takes over the joints' numbers and the model's step. joints: as before, with their step set.
  void ReadNumbers(const mjModel* m, const std::vector<BoundJoint>& joints);

  /// Begins a step with the joints' speeds and states. joints: as before, and until the step has
  /// ended; states: d->act or d->plugin_state.
  void Load(const mjData* d, const std::vector<BoundJoint>& joints, const mjtNum* states) {
    d_ = d;
    joints_ = joints.data();
    states_.Load(d, joints, states, numbers_.data());
  }

  /// The heat {E1, E2} with which a joint begins, N.m or N, and the rise of its ambient, K.
  std::array<double, 2> energies(size_t joint) const {
    return {Of(joint, kFirst), Of(joint, kSecond)};
  }
  void SetEnergies(size_t joint, const std::array<double, 2>& energies) {
    Of(joint, kFirst) = energies[0];
    Of(joint, kSecond) = energies[1];
  }
  void SetAmbientRise(size_t joint, double rise) { Of(joint, kRise) = rise; }

  /// Steps all joints, whose states are loaded. load: what each degree of freedom transmits, N.m or
  /// N; not read where no joint needs it.
  void Step(const mjModel* m, const mjtNum* load);

  /// What the step yields: F of a joint, N.m or N, and the next states of all joints, in the order
  /// of each joint's state(), one joint after the other.
  double force(size_t joint) const {
    return Of(joint, kForce) + Of(joint, kDamping) * Of(joint, kSpeed);
  }
  const std::vector<double>& next() const { return states_.next(); }

  /// Takes F, without what the joints' damping adds, from the forces of all degrees of freedom, N.m or N.
  void TakeFrom(mjtNum* forces) const { states_.TakeForces(numbers_.data(), forces); }

  /// Writes -F of all joints of the actuator form, without what the joints' damping adds, N.m or N.
  void GiveTo(mjtNum* outputs) const { states_.GiveForces(numbers_.data(), outputs); }

  /// TakeFrom for those for which `acts`.
  template <typename Acts>
  void TakeFrom(mjtNum* forces, const Acts& acts) const {
    for (const JointStates::At& at : states_.at()) {
      if (acts(at.dof)) forces[at.dof] -= numbers_[at.place + 2 * kForce];
    }
  }

  /// What a sensor tells of a joint besides: loss, W, and whether it slides.
  double loss(size_t joint) const { return Of(joint, kLoss); }
  bool slides(size_t joint) const { return Of(joint, kSliding) != 0; }

  /// The joints that friction would have pushed in this step.
  const std::vector<size_t>& pushed() const { return pushed_; }

 private:
  size_t PlaceIn(size_t joint, Column column) const {
    return states_.at()[joint].place + 2 * column;
  }
  double& Of(size_t joint, Column column) { return numbers_[PlaceIn(joint, column)]; }
  double Of(size_t joint, Column column) const { return numbers_[PlaceIn(joint, column)]; }
  double LevelAt(size_t row, int side) const override;
  FrictionState StateOf(size_t joint) const;
  JointMotion MotionOf(size_t joint) const;
  void SetLevels();
  void SetSlopes();
  bool Complete();
  void StepHeats();
  void StepAlone(const mjModel* m);
  void Take(size_t joint, const FrictionStep& step);
  void TakeDeficits();

  CoupledBristles bristles_;
  RowNumbers numbers_;
  JointStates states_;
  std::vector<size_t> alone_;     // joints with a bristle of their own
  std::vector<size_t> joint_at_;  // of each row

  bool slopes_change_ = false;  // of any joint, by its heat
  bool have_one_stage_ = true;  // all joints (Heat)

  // of one step
  const mjData* d_ = nullptr;
  const BoundJoint* joints_ = nullptr;
  const mjtNum* load_ = nullptr;
  std::vector<size_t> pushed_;
};

}  // namespace warmjoint
