// The frictions that a prior holds possible, and what a motion tells of each.
#pragma once

#include <warmjoint/design.h>

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "identification/fields/field_block.h"
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
  /// noise: standard deviation of a sample, N.m or N; rate: samples in a second; curve: slowest and fastest speed where the fit has a field over
  /// the speed
  PossibleJoint(Friction friction, StartBelief start, double noise, double rate,
                std::optional<std::array<double, 2>> curve = {});

  const Friction& friction() const { return friction_; }
  bool HasCurve() const { return curve_.size() > 0; }
  /// What an earlier log tells of the same parameters joins all information from here on.
  void Know(const MotionCells& earlier) { known_ += Information(earlier); }
  /// [p] names of the law's parameters and of the heat's.
  const std::vector<std::string>& names() const { return names_; }
  /// Information about the parameters and behind them the m values of the curve, [p + m x p + m], by the samples at constant speed: J^T J over
  /// the noise's variance, J the derivatives of the fits' own model, and by what is known; an E(0) that is estimated is integrated out.
  Eigen::MatrixXd Information(const MotionCells& cells) const;
  /// J^T J over the samples, [p + m x p + m]: x^T of it x is the mean square change by a change x of the friction at the motion's speeds, half
  /// of it along the motion, half of it cold.
  Eigen::MatrixXd MeanSquare(const MotionCells& cells) const;

 private:
  struct Samples {
    Eigen::MatrixXd rows;     // [n x p + m + 1 or p + m] derivatives by parameters, curve and E(0)
    Eigen::VectorXd seconds;  // [n] that a cell counts, 0 once the joint would drive itself
  };
  Samples SamplesOf(const MotionCells& cells) const;

  Friction friction_;
  StartBelief start_;
  double noise_, rate_;
  std::vector<std::string> names_;
  Eigen::VectorXd values_;  // [d] of the law
  Knots curve_{};           // [m] over the root of the speed, or none
  Eigen::VectorXd scales_;  // [p + m + 1] of parameters, curve and E(0)
  Eigen::MatrixXd known_;   // [p + m x p + m]
};

/// Logarithm of the standard deviation of what is aimed at, relative to its value: half of log(c^T C c) for a parameter, of
/// log trace(C M) for the friction along a motion, of log det(C) / p for everything. C: the inverse of the information, for the friction with
/// the curve, else of law and heat alone.
class AimCost {
 public:
  /// usual: a motion of which the friction is to be known. Throws BadInput for a parameter that the joint lacks.
  AimCost(const DesignAim& aim, const PossibleJoint& joint, const MotionCells& usual);
  double operator()(const Eigen::MatrixXd& information) const;

 private:
  AimKind kind_;
  Eigen::Index parameter_ = 0, parameters_;
  Eigen::MatrixXd mean_square_;
};

/// Relative standard deviations of a joint's parameters, of law and heat alone. [p]
Eigen::VectorXd Deviations(const PossibleJoint& joint, const MotionCells& cells);

}  // namespace warmjoint
