// A fitted friction where pictures look at it: over velocity, at a heat, over an angle.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tools/shown/fit_view.h"

namespace warmjoint::shown {

/// Friction over velocity in one direction at a heat. All [m].
struct FrictionCurve {
  double energy = 0;  // E, torque unit
  Eigen::VectorXd speed;
  Eigen::VectorXd force;
  Eigen::VectorXd
      deviation;  // standard deviation by the estimate's parameters; empty where it is not known
};

/// Of a cold joint, and where it warms at half of the recording's largest heat and at all of it, from the slowest to the fastest kept
/// sample of each direction. Empty with maps, which have no curve over velocity.
std::vector<FrictionCurve> CurvesOf(const FitView& view);

/// The force of steady sliding at every kept sample, were the joint at one heat, NaN elsewhere, [N]. Of a friction with maps.
struct ForceAtHeat {
  double energy = 0;
  Eigen::VectorXd force;
};
std::vector<ForceAtHeat> ForcesOf(const FitView& view);

/// The force of steady sliding at every kept sample, with all maps and without those over the motor's angle, NaN elsewhere, [N] each.
struct MotorMaps {
  Eigen::VectorXd with, without;
};
MotorMaps MotorMapsOf(const FitView& view);

/// sign(v) F over an angle and velocity at a heat, for each in `energies`: [rows x columns], rows at even velocities from -fastest to
/// fastest. Over the motor's angle at the mean position.
struct AngleMap {
  bool over_motor = false;  // its angle, 0 to 2 pi; else the joint's position
  double lower = 0, upper = 0;
  double fastest = 0;
  std::vector<double> energies;
  std::vector<Eigen::MatrixXd> levels;
};
/// Nothing where no map is over an angle.
std::optional<AngleMap> AngleMapOf(const FitView& view);

}  // namespace warmjoint::shown
