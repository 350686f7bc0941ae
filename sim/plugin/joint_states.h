// The states of an instance's joints, between mjData and the rows of a step.
#pragma once

#include <mujoco/mujoco.h>

#include <limits>
#include <vector>

#include "models/friction/joint_friction.h"
#include "sim/plugin/bound_joints.h"
#include "sim/plugin/row_pairs.h"

namespace warmjoint {

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

/// A stretch of an instance's states that has no gaps.
struct StateRun {
  int begin;  // in act or plugin_state
  int next;   // among the states of all joints, one joint after the other
  int states;
};

/// Remembers, bit for bit, the states of an instance's joints where a step has left them: what the
/// engine's rounding has made of act, too. Who sets a state, resets, or steps another simulation with
/// the same data leaves others there, or another time.
class LeftStates {
 public:
  LeftStates() = default;
  explicit LeftStates(const std::vector<BoundJoint>& joints);

  /// Whether these are the states and the time that were kept. states: d->act or d->plugin_state.
  bool Match(const mjtNum* states, double time) const;

  /// Keeps them at the end of a step.
  void Keep(const mjtNum* states, double time);

  /// Ends a step with these next states of all joints, one joint after the other: writes and keeps them.
  void Put(const std::vector<double>& next, mjtNum* states, double time);

  /// Finds the rates of act, act_dot, by which the engine's Euler step of h s lands on the next states,
  /// and keeps where its rounding leaves them, until Ended. False where a rate is no finite number.
  bool FindRates(const std::vector<double>& next, const mjtNum* act, double h, mjtNum* act_dot);

  /// The engine has made that step.
  void Ended(double time) { time_ = time; }

 private:
  std::vector<StateRun> runs_;  // all states, as few stretches as there are
  std::vector<double> left_;    // of all joints, one joint after the other
  double time_ = std::numeric_limits<double>::quiet_NaN();  // s; matches none before the first step
};

}  // namespace warmjoint
