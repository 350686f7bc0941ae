// The friction of one joint of a robot: its rigid torque as given columns that may be wrong, friction, rotor, ripple and heat.
#pragma once

#include <warmjoint/fields.h>
#include <warmjoint/friction.h>

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "identification/fit/fit.h"
#include "identification/model/model.h"
#include "identification/model/solve.h"
#include "identification/uncertainty/uncertainty.h"

namespace warmjoint {

/// Shares of the top speed at which the rise of friction at low speed has fallen to 1/e. Why .08: joints of seven robots rise at .04 to .15 of
/// their top speed, and their logs determine the size of the rise, not the speed at which it falls. The others are those of a
/// friction that falls over all its speeds.
inline constexpr std::array kSlowShares{.08, .2, .5};

inline constexpr double kLeastTravel = .05;  // rad or m: a joint that is held moves by less

/// The columns of a joint's filtered log for a fit: N samples, even in time within each recording. All columns passed the
/// filter of the torque.
struct JointColumns {
  std::string joint;
  JointKind kind = JointKind::rotary;
  std::string torque_unit = "N.m";
  double step = 0;       // s
  double top_speed = 0;  // rad/s or m/s
  Eigen::VectorXd position, velocity,
      acceleration;      // [N] of the motor where joints are coupled; rad or m
  Eigen::VectorXd sign;  // [N] of the velocity, unfiltered
  /// [N] 1 where the joint moves in that direction, through the filter
  Eigen::VectorXd forwards, backwards;
  /// [N x 3] exp(-(v / (share of the top speed))^2) in its direction, through the filter; of each of kSlowShares
  Eigen::MatrixXd slow;
  Eigen::MatrixXd ripple;  // [N x 4h] harmonics of the motor's angle in each direction; or [N x 0]
  GivenForce rigid;        // gravity, Coriolis and inertia by the description, N.m or N
  GivenForce carried;      // without inertia: what loads the joint
  /// What `rigid` follows from: parameters of the description [10 L], and their change by each of the directions [10 L x r].
  Eigen::VectorXd described;
  Eigen::MatrixXd basis;
  ModelSamples samples;

  /// Direction in which friction brakes, through the filter. [N]
  Eigen::VectorXd Direction() const { return forwards - backwards; }
  /// Further directions in which the given torque may be wrong, unknowns with the prior N(0, 1). of_rigid, of_carried: [N x k]
  void AddDirections(const Eigen::MatrixXd& of_rigid, const Eigen::MatrixXd& of_carried);
};

/// The settings of the fit of a joint.
struct JointQuestion {
  std::optional<double> gain_spread{};  // deviation of the log gain, in place of PriorOfGain's
  double middle_gain = 1;               // of the robot's joints, torque_unit for N.m or N
  bool warms = true;                    // whether warming is looked for
  bool slows =
      true;  // whether a rise of friction at low speed is looked for, where viscous friction is not below 0
  double error_level = .01;  // of the claim that one of all joints warms
  int joints = 1;            // of the robot that move
  FieldSet fields{};
};

/// The gain as the log of a joint by itself determines it, the description taken as true.
struct GainGuess {
  double value = 1;
  double deviations = 0;  // |value| over its standard deviation
  double braking = 0;     // mean friction against the motion over its standard deviation

  /// Why 5: noise alone does not reach it, and errors of the description change the gain by a tenth.
  bool IsSure() const { return deviations > 5; }
  /// The gain, or another where it is not sure.
  double Or(double otherwise) const { return IsSure() ? value : otherwise; }
  /// Whether friction drives the joint: the sign of its torque is turned.
  bool IsTurned() const { return braking < -5; }
  bool Brakes() const { return braking > 5; }
};

/// How a guess takes the description: as true, or as wrong as its prior allows at a gain of 1.
enum class Description { as_true, as_prior };
GainGuess GuessGain(const JointColumns& columns, Description description = Description::as_true);

/// What is known of a joint's gain before its log is fitted: its logarithm is normal.
struct GainPrior {
  double middle = 1;
  double spread = 1;  // deviation of the logarithm
};

/// A factor between the gains of alike torques: descriptions are wrong by a tenth or two, constants of motors by as much.
inline constexpr double kAlikeGains = 1.4;
/// A factor that no description is wrong by: the torque is of another unit, or of another side of a gear.
inline constexpr double kOtherUnit = 3;

/// In N.m or N a gain is 1, to within kAlikeGains with 95 %, unless the joint's own is sure to be another; in A, where motors are alike and
/// not equal, it is the robot's middle gain, to within a factor of e.
GainPrior PriorOfGain(const JointColumns& columns, const GainGuess& guess, double middle_gain);
/// Whether the torque is in N.m or N.
bool IsTorque(const JointColumns& columns);

/// The fields about a joint's fit.
struct FieldsOfJoint {
  FieldSet asked;
  Fit fit;  // of the joint's table, with them
};

/// A joint's friction as it was fitted. Its law has viscous, coulomb_positive, coulomb_negative and, where it slows, static_rise.
struct JointFit {
  Model model;
  SolvedModel solved;
  Uncertainty uncertainty;          // of x
  double effective_parameters = 0;  // that the log determines, and not the priors
  double slow_share = 0;            // of kSlowShares, where friction rises at low speed
  double warming =
      0;  // by how many deviations friction changes with the heat of its losses, at the best tau
  /// by how many times its prior the description is wrong; 1 where chance explains its errors
  double description_error = 1;
  std::vector<std::string> beyond;  // rows of the law beyond their bound, beyond chance
  std::shared_ptr<const FieldsOfJoint> fields{};

  Slice At(Role role) const { return model.At(role); }
  /// Whether the model has a part.
  bool Has(Role role) const { return At(role).size > 0; }
  bool Slows() const { return At(Role::law).size == 4; }
  /// The unknowns of the rigid torque.
  GivenPlaces Given() const;
  double Value(Eigen::Index row) const { return solved.x[row]; }
  double Deviation(Eigen::Index row) const { return std::sqrt(uncertainty.covariance(row, row)); }
};

/// The fit. guess: of its gain.
JointFit FitJoint(const JointColumns& columns, const GainGuess& guess,
                  const JointQuestion& question);

}  // namespace warmjoint
