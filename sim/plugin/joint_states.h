// The states of an instance's joints, between mjData and the rows of a step.
#pragma once

#include <mujoco/mujoco.h>

#include <vector>

#include "models/friction/joint_friction.h"
#include "sim/plugin/bound_joints.h"
#include "sim/plugin/row_pairs.h"

namespace warmjoint::inline sim {

/// Loads speeds and states of joints into rows, and stores the next states in the order of each joint's
/// state(), one joint after the other. What is no number counts as 0 (JointFriction::Load).
class JointStates {
 public:
  /// Where a joint's numbers are.
  struct At {
    size_t place;  // in the rows
    int dof;
    int state;   // in act or plugin_state
    int next;    // in next()
    int output;  // in actuator_force; -1 in the passive form
    bool plain;  // whether it has two states
  };

  JointStates() = default;
  /// places: of each joint in the rows.
  JointStates(const std::vector<BoundJoint>& joints, const std::vector<size_t>& places);

  const std::vector<At>& at() const { return at_; }

  /// Begins a step. joints: as before, and until the step has ended; states: d->act or d->plugin_state.
  void Load(const mjData* d, const std::vector<BoundJoint>& joints, const mjtNum* states,
            double* rows);

  /// The state with which a joint began the step.
  FrictionState Before(size_t joint) const {
    return joints_[joint].friction.Load(states_ + at_[joint].state);
  }

  /// Takes F of all joints from the forces of the degrees of freedom.
  void TakeForces(const double* rows, mjtNum* forces) const;

  /// Writes -F of all joints of the actuator form.
  void GiveForces(const double* rows, mjtNum* outputs) const;

  /// Ends a step. A joint whose next state would be no number keeps the one before, and has no force.
  void Store(double* rows);

  const std::vector<double>& next() const { return next_; }

 private:
  void FindTwos();
  void LoadOne(size_t joint, double* rows) const;
  void StoreOne(size_t joint, double* rows);

  std::vector<At> at_;        // of each joint
  std::vector<At> twos_;      // the first of two that follow each other in all of this, both plain
  std::vector<size_t> ones_;  // the others

  // of one step
  const mjData* d_ = nullptr;
  const BoundJoint* joints_ = nullptr;
  const mjtNum* states_ = nullptr;
  std::vector<double> next_;  // of each state
};

}  // namespace warmjoint::inline sim
