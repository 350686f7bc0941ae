// Least squares of a LuGre law over a recorded motion, by Ceres.
#pragma once

#include <warmjoint/prepared_log.h>

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

#include "identification/nonlinear/falling_law.h"

namespace warmjoint {

/// tau = F + M a over the samples of `used`. The bristle runs over all samples; how it is bent as
/// each recording begins is estimated in addition to x.
struct LugreProblem {
  MotionPieces motion;                                   // of the N samples
  Eigen::VectorXd acceleration;                          // [N] rad/s^2 or m/s^2
  Eigen::VectorXd torque;                                // [N] N.m or N
  Selection used;                                        // samples of the fit
  Eigen::VectorXd deviation;                             // [n] of each one's noise, N.m or N
  std::vector<int> constant;                             // parameters of x that stay as they are
  const FallingLaw* law = &FindFallingLaw(LuGre::name);  // one of BristleFallingLaws

  const FallingPlaces& places() const { return law->places; }
  bool IsConstant(Eigen::Index parameter) const {
    return std::count(constant.begin(), constant.end(), parameter) > 0;
  }
  /// One past the last sample of the recording that begins at `first`.
  Eigen::Index EndOfRecording(Eigen::Index first) const {
    Eigen::Index end = first + 1;
    while (end < motion.size() && !motion.Begins(end)) ++end;
    return end;
  }
};

/// Points on a grid over sigma0 and sigma1: presliding distances d = ks / sigma0 from a quarter of
/// the shortest distance between samples to the longest between turns, and sigma1 / sigma0 of 0, 1 and
/// 10 sampling intervals. steady(d): x with law and ln vs of the samples that slide steadily then, nothing
/// where they do not determine it. The inertia is what suits each best. Best first, by the sum of squared residuals,
/// each over its deviation.
std::vector<FitPoint> ScanBristle(
    const LugreProblem& problem, const LogSamples& measurements,
    const std::function<std::optional<Eigen::VectorXd>(double distance)>& steady);

/// A point with its fall from the level at rest replaced by others: vs at 16 values, even in ln vs
/// over three decades up to the fastest sample, each with the levels, the slope and the inertia that
/// suit it best, since those of the point may belong to a fall that the log does not have. Best first.
std::vector<FitPoint> ScanFall(const LugreProblem& problem, const FitPoint& point, double fastest);

struct LugreFit {
  FitPoint solution;          // squares: over the deviations
  Eigen::VectorXd residual;   // [n] tau - F - M a, over the deviations
  Eigen::MatrixXd jacobian;   // [n x p] of F + M a by x, over the deviations, exact
  std::vector<double> loads;  // [R] with which the recordings begin, N.m or N
  bool converged = false;
};

/// Minimises the sum of squares from a start by Levenberg-Marquardt.
LugreFit RefineLugre(const LugreProblem& problem, const FitPoint& start);

/// F + M a of a fit over all samples of a problem, whose recordings begin with its loads. [N] N.m or N
Eigen::VectorXd LugreTorque(const LugreProblem& problem, const LugreFit& fit);

}  // namespace warmjoint
