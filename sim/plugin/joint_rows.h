// The joints of an instance through one step: a column for each of their numbers.
#pragma once

#include <mujoco/mujoco.h>

#include <array>
#include <vector>

#include "models/friction/joint_friction.h"
#include "sim/plugin/bound_joints.h"
#include "sim/plugin/coupled_bristles.h"

namespace warmjoint::inline sim {

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
  void Load(const mjData* d, const std::vector<BoundJoint>& joints, const mjtNum* states);

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
  double force(size_t joint) const { return Of(joint, kForce); }
  const std::vector<double>& next() const { return next_; }

  /// What a sensor tells of a joint besides: loss, W, and whether it slides.
  double loss(size_t joint) const { return Of(joint, kLoss); }
  bool slides(size_t joint) const { return Of(joint, kSliding) != 0; }

  /// The joints that friction would have pushed in this step.
  const std::vector<size_t>& pushed() const { return pushed_; }

 private:
  double& Of(size_t joint, Column column) { return numbers_[at_[joint].place + 2 * column]; }
  double Of(size_t joint, Column column) const { return numbers_[at_[joint].place + 2 * column]; }
  double LevelAt(size_t row, int side) const override;
  FrictionState StateOf(size_t joint) const;
  JointMotion MotionOf(size_t joint) const;
  void SetLevels();
  void Complete();
  void StepAlone(const mjModel* m);
  void Take(size_t joint, const FrictionStep& step);
  void TakeDeficit(size_t joint);
  void FindTwos();
  void LoadOne(size_t joint);
  void Store();
  void StoreOne(size_t joint);

  /// Where a joint's numbers are.
  struct At {
    size_t place;  // in numbers_
    int dof;
    int state;   // in act or plugin_state
    int next;    // in next_
    bool plain;  // whether it has two states
  };

  CoupledBristles bristles_;
  RowNumbers numbers_;
  std::vector<At> at_;                   // of each joint
  std::vector<std::array<At, 2>> twos_;  // joints that are one pair of rows, with two states each
  std::vector<size_t> ones_;             // the others
  std::vector<size_t> alone_;            // joints with a bristle of their own
  std::vector<size_t> joint_at_;         // of each row

  // of one step
  const mjData* d_ = nullptr;
  const BoundJoint* joints_ = nullptr;
  const mjtNum *states_ = nullptr, *load_ = nullptr;
  std::vector<size_t> pushed_;
  std::vector<double> next_;  // of each state
};

}  // namespace warmjoint::inline sim
