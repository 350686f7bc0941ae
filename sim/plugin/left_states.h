// The states that a step has left, to tell whether the next step goes on from them.
#pragma once

#include <mujoco/mujoco.h>

#include <limits>
#include <vector>

#include "sim/plugin/bound_joints.h"

namespace warmjoint::inline sim {

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

  /// All states, as few stretches as there are.
  const std::vector<StateRun>& runs() const { return runs_; }

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
  std::vector<StateRun> runs_;
  std::vector<double> left_;  // of all joints, one joint after the other
  double time_ = std::numeric_limits<double>::quiet_NaN();  // s; matches none before the first step
};

}  // namespace warmjoint::inline sim
