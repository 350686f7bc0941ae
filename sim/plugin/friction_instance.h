// One instance of the plugin: the friction of its joints, bound to a model.
#pragma once

#include <mujoco/mujoco.h>

#include <vector>

#include "models/friction/joint_friction.h"
#include "sim/plugin/attributes.h"

namespace warmjoint::inline sim {

/// Name under which MuJoCo knows the plugin.
inline constexpr char kFrictionPlugin[] = "warmjoint.friction";

/// Entries of mjData.plugin_state of each instance. They report, until a reset, and are never read
/// by the plugin's dynamics.
enum FrictionReport : int {
  /// The sum of 2^i over those of the instance's joints, counted from 0 in the order of their
  /// actuators, in which friction would have pushed.
  kReportsPush,
  /// 1 where a step was asked for with the integrator RK4, under which there is no friction.
  kReportsIntegrator,
  kFrictionReports,
};

/// Friction of the joints whose actuators share one plugin instance. Keeps no state of its own
/// beyond scratch: all state is in mjData.act.
class FrictionInstance {
 public:
  /// Reads the instance's attributes and checks them and its actuators against the model.
  /// Throws BadInput that names actuator, attribute, value and bound.
  FrictionInstance(const mjModel* m, int instance);

  /// Steps every joint: writes act_dot = (next - now) / h, so that the engine's Euler step of act
  /// lands on the next state, and keeps the forces for Apply. Allocates and locks nothing.
  /// With the integrator RK4, which a model that has one is refused for but a program may still set
  /// later, the states stay as they are and the forces are 0: RK4 asks four times a step, and
  /// nothing in mjData tells the inner calls from the first, so that none of the four could be
  /// answered right. A warning says so once.
  void Step(const mjModel* m, mjData* d);

  /// Writes actuator_force = -F of the last Step.
  void Apply(const mjModel* m, mjData* d) const;

 private:
  /// One actuator and where its joint's numbers stand in the model.
  struct Joint {
    int actuator = 0;
    int dof = 0;
    int position = 0;  // in qpos
    int state = 0;     // in act
    int control = 0;   // in ctrl
    int output = 0;    // in actuator_force
    bool needs_load = false;
    bool needs_ambient = false;
    JointFriction friction;
    double force = 0;  // F of the last step, N.m or N
  };

  void Bind(const mjModel* m, int actuator, const FrictionDescription& friction);
  static JointMotion MotionOf(const mjModel* m, const mjData* d, const Joint& joint);
  void Report(const mjModel* m, mjData* d, const Joint& joint);
  void LetGo(const mjModel* m, mjData* d);

  int instance_;
  double timestep_;
  std::vector<Joint> joints_;
};

}  // namespace warmjoint::inline sim
