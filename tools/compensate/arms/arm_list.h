// The family of compensators that suites compare: its one list.
#pragma once

#include <warmjoint/friction.h>
#include <warmjoint/prepared_log.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identification/options.h"

namespace warmjoint {

/// What a compensator may use.
struct CompensatorInput {
  const LogSamples& log;     // today's, as it was measured
  const LogSamples& before;  // the day before, of the same joint
  /// What a friction file says of the joint: its law, its load and its first stage of heat, no surroundings.
  const Friction& known;
  const Options& options;
  const Eigen::VectorXd* truth;  // [N] N.m or N; of one that sees it
};

/// Whether a compensator is told the true friction: a measure for the others.
enum class Sees { log, truth };

struct CompensatorArm {
  std::string name;
  std::string summary;
  Options options;  // at their defaults
  /// Friction at each sample, [N] N.m or N, by the samples before it.
  Eigen::VectorXd (*along)(const CompensatorInput& input);
  Sees sees = Sees::log;
};

/// Each is described at the top of its file.
CompensatorArm NoCompensation();
CompensatorArm FixedFriction();
CompensatorArm ForgettingLeastSquares();
CompensatorArm AdaptingLevel();
CompensatorArm PolynomialInHeat();
CompensatorArm FrictionWithHeat();
CompensatorArm TrueFriction();

/// All compensators: a new one is a file in this folder, a line above, and one in arm_list.cc.
const std::vector<CompensatorArm>& CompensatorArms();

/// The one of this name. Throws BadInput with the nearest name.
const CompensatorArm& FindCompensator(const std::string& name);

/// A friction k v + c sign(v).
struct SpeedLine {
  double viscous = 0;  // N.m.s/rad or N.s/m
  double level = 0;    // N.m or N

  double At(double velocity) const;
};

/// By least squares over the samples from `begin` to before `end` (s) that move, both directions alike.
SpeedLine LineOf(const LogSamples& log, double begin, double end);

/// Deviation of the noise of a log's torque, N.m or N.
double NoiseOf(const LogSamples& log);

/// The steps of a motion: time since the sample before, 0 at the first, s. [N]
Eigen::VectorXd StepsOf(const LogSamples& log);

}  // namespace warmjoint
