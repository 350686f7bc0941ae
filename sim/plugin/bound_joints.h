// The joints of a plugin instance, found in a model, and what stands where in the data.
#pragma once

#include <mujoco/mujoco.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "models/friction/joint_friction.h"
#include "sim/plugin/prepared_instances.h"
#include "sim/plugin/stability.h"

namespace warmjoint {

/// One joint and where its numbers stand in the model's data.
struct BoundJoint {
  int joint = 0;
  int dof = 0;
  int position = 0;   // in qpos
  int actuator = -1;  // -1 in the passive form
  int state = 0;      // in act, or in plugin_state in the passive form
  int control = -1;   // in ctrl; -1 where it has none
  int output = -1;    // in actuator_force; -1 in the passive form
  int instances = 1;  // on its kinematic tree
  double drive = 0;   // the tree's StiffestDrives, or what the attributes say
  Viscous viscous = Viscous::by_plugin;
  double damping = 0;  // that the engine adds as friction's viscous, N.m.s/rad or N.s/m
  bool needs_load = false;
  bool needs_ambient = false;
  JointFriction friction;                  // without a timestep
  std::array<double, 2> initial_energy{};  // {E1, E2} at a reset, N.m or N
};

/// An array of the model that holds a number of each joint: <numeric name="INSTANCE/NUMBER">.
struct NumberArray {
  std::string name;               // of the array
  int address = 0;                // in numeric_data
  std::optional<size_t> stage{};  // of the heat at a reset, whose array it is
  std::vector<std::optional<size_t>>
      places;                 // of each joint's number; none where it has no such number
  std::vector<double> given;  // by the attributes, for each joint
  std::vector<double> last;   // what each joint's number was set to
  std::vector<bool> told;     // that it was out of its bounds, for each joint
};

/// The arrays of the heat at a reset, E1 and E2.
inline constexpr std::array kInitialEnergies{"initial_energy", "second_initial_energy"};

/// A sensor of the model that reads the instance.
struct BoundSensor {
  int sensor = 0;
  std::optional<size_t> joint{};  // among the instance's; none: all of them
};

/// Entries of mjData.plugin_state of each instance, before the states of a passive one's joints. One
/// more stands behind those: the mark of the attributes with which the state was stepped or reset
/// (AttributeWatch), which tells apart states of models that one place in memory holds in turn. That mark
/// and the first two are never read by the dynamics.
enum FrictionReport : int {
  /// The sum of 2^i over those of the instance's joints, counted from 0 in their order (BoundJoints),
  /// in which friction would have pushed, until a reset.
  kReportsPush,
  /// 1 where the model's step was set to one that cannot carry the friction, until a reset.
  kReportsStep,
  /// Passive form: rise of the ambient temperature, Ts - T0, K, for all joints; 0 after a reset.
  kAmbientRise,
  /// Actuator form: 1 from a reset to the first step where joints start warm; that step begins at
  /// their initial energy where act holds 0.
  kStartsWarm = kAmbientRise,
  kFrictionReports,
};

/// So many are in plugin_state beside the states of a passive instance's joints.
inline constexpr int kFrictionEntries = kFrictionReports + 1;

/// The joints of an instance in one model: in the order of its actuators, or of the model's joints
/// where no actuator refers to it (the passive form).
class BoundJoints {
 public:
  /// Reads the instance's attributes and checks them and its joints against the model. Throws BadInput
  /// that names actuator or joint, attribute, value and bound.
  BoundJoints(const mjModel* m, int instance);

  /// Whether these joints are those of the instance in that model.
  bool FitsModel(const mjModel* m) {
    return IsPlaceOf(m) && text_.Same(AttributeText(m, instance_));
  }

  /// Whether the model is where these joints were found, and no other one was announced since.
  bool Undisturbed(const mjModel* m) const { return IsPlaceOf(m) && text_.Quiet(); }

  /// What tells the instance's attributes from others in a state (AttributeWatch).
  double mark() const { return text_.mark(); }

  bool passive() const { return passive_; }
  std::vector<BoundJoint>& joints() { return joints_; }
  const std::vector<BoundJoint>& joints() const { return joints_; }
  /// The model's sensors that read the instance.
  const std::vector<BoundSensor>& sensors() const { return sensors_; }
  /// The model's arrays of numbers.
  const std::vector<NumberArray>& numbers() const { return numbers_; }

  /// Sets what the model's drives add to its step, which its timestep, integrator and inertias change.
  void ReadDrives(const mjModel* m);

  /// Whether a program has set inertias of the model since the last look.
  bool ReadInertias(const mjModel* m);

  /// The friction of one of the joints as the model's step sees it now.
  SteppedFriction Stepped(const mjModel* m, const BoundJoint& joint) const;

  /// The slopes that the plugin adds to each degree of freedom (StiffestDrives).
  std::vector<double> Slopes(const mjModel* m) const;

  /// Sets the joints' numbers to those of the model's arrays and dampings; whether any is new. For a number out of
  /// its bounds the attributes' one acts, with a warning, once for each; one that a joint's friction
  /// does not have changes nothing.
  bool ReadNumbers(const mjModel* m);

 private:
  bool IsPlaceOf(const mjModel* m) const { return m == model_ && m->signature == signature_; }
  bool ReadDampings(const mjModel* m);
  bool SetNumber(const NumberArray& array, size_t joint, double value);
  void WarnOfNumber(const mjModel* m, NumberArray& array, size_t joint, double value) const;
  Place PlaceOf(const mjModel* m, int joint, int actuator) const;
  void CheckJoints(const mjModel* m) const;
  void BindJoints(const mjModel* m);
  void BindSensors(const mjModel* m);
  void BindNumbers(const mjModel* m);

  int instance_;
  const mjModel* model_;
  AttributeWatch text_;
  uint64_t signature_;  // of the model
  bool passive_;
  std::vector<BoundJoint> joints_;
  std::vector<BoundSensor> sensors_;
  std::vector<NumberArray> numbers_;
  double stiffest_drive_ = 0;     // as the attributes say
  std::vector<mjtNum> inertias_;  // [3 nv] dof_armature, dof_invweight0, dof_M0 at the last look
  std::vector<mjtNum>
      armatures_;  // [nv] with which the compiler or mj_setConst found dof_invweight0
};

/// Numbers of each joint in a sensor of the instance: force on the joint (N.m or N), energy state
/// (N.m or N), rise of its temperature (K; 0 without level_per_temperature), loss (W), 1 held or 0
/// sliding.
inline constexpr int kSensed = 5;

/// Numbers of sensordata that a sensor of the instance needs: kSensed for each of its joints, or where
/// it has joint_sensors for one. While a model is compiled, sensors do not yet know what they name.
int SensorSize(const mjModel* m, int instance);

}  // namespace warmjoint
