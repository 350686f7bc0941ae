// The frictions that a prior holds possible, and what a motion tells of each.
#pragma once

#include <warmjoint/design.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "scenarios/truth_draws.h"
#include "tools/design/motion_plan.h"

namespace warmjoint {

/// The friction that is expected: settings.prior, or broad ranges about a level of 10 N.m for the limits' speeds. Throws BadInput,
/// also for a law that is not linear in its parameters.
DrawnFriction PriorOf(const DesignSettings& settings);

/// The middle of a prior, and draws of it that lie as far from it and from each other as they can. count: of all of them; one where nothing is drawn
std::vector<Friction> Representatives(const DrawnFriction& prior, std::uint64_t seed, int count);

/// A friction of law and heat along motions. Parameters are relative to their values, so that deviations are shares.
class PossibleJoint {
 public:
  /// noise: standard deviation of a sample, N.m or N; rate: samples in a second
  PossibleJoint(Friction friction, StartBelief start, double noise, double rate);

  const Friction& friction() const { return friction_; }
  /// What an earlier log tells of the same parameters joins all information from here on.
  void Know(const MotionCells& earlier) { known_ += Information(earlier); }
  /// [p] names of the law's parameters and of the heat's.
  const std::vector<std::string>& names() const { return names_; }
  /// Information about the parameters, [p x p], by the samples at constant speed: J^T J over the noise's variance, J the derivatives
  /// of the fits' own model, and by what is known; an E(0) that is estimated is integrated out.
  Eigen::MatrixXd Information(const MotionCells& cells) const;
  /// J^T J over the samples, [p x p]: x^T of it x is the mean square change of the friction along the motion by a change x.
  Eigen::MatrixXd MeanSquare(const MotionCells& cells) const;

 private:
  struct Samples {
    Eigen::MatrixXd rows;     // [n x p + 1 or p] derivatives by parameters and E(0)
    Eigen::VectorXd seconds;  // [n] that a cell counts, 0 once the joint would drive itself
  };
  Samples SamplesOf(const MotionCells& cells) const;

  Friction friction_;
  StartBelief start_;
  double noise_, rate_;
  std::vector<std::string> names_;
  Eigen::VectorXd values_;  // [d] of the law
  Eigen::VectorXd scales_;  // [p + 1] of parameters and E(0)
  Eigen::MatrixXd known_;   // [p x p]
};

/// Logarithm of the standard deviation of what is aimed at, relative to its value: half of log(c^T C c) for a parameter, of
/// log trace(C M) for the friction along a motion, of log det(C) / p for everything. C: the inverse of the information.
class AimCost {
 public:
  /// usual: a motion of which the friction is to be known. Throws BadInput for a parameter that the joint lacks.
  AimCost(const DesignAim& aim, const PossibleJoint& joint, const MotionCells& usual);
  double operator()(const Eigen::MatrixXd& information) const;

 private:
  AimKind kind_;
  Eigen::Index parameter_ = 0;
  Eigen::MatrixXd mean_square_;
};

/// Relative standard deviations of all parameters. [p]
Eigen::VectorXd Deviations(const Eigen::MatrixXd& information);

}  // namespace warmjoint
