// Least squares of a LuGre law over a recorded motion, by Ceres.
#pragma once

#include <warmjoint/prepared_log.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "identification/nonlinear/falling_law.h"

namespace warmjoint {

/// tau = F + M a over the samples of `used`. The bristle runs over all samples; how it is bent as
/// each recording begins is estimated beside x.
struct LugreProblem {
  MotionPieces motion;                                   // of the N samples
  Eigen::VectorXd acceleration;                          // [N] rad/s^2 or m/s^2
  Eigen::VectorXd torque;                                // [N] N.m or N
  Selection used;                                        // samples of the fit
  Eigen::VectorXd deviation;                             // [n] of each one's noise, N.m or N
  std::vector<int> constant;                             // parameters of x that stay as they are
  const FallingLaw* law = &FindFallingLaw(LuGre::name);  // one of BristleFallingLaws

  /// Where these stand in x, behind the law's l linear parameters, and how many x has. Up to the inertia
  /// they stand as in the law's table.
  Eigen::Index log_vs() const { return law->levels(); }
  Eigen::Index log_stiffness() const { return log_vs() + 1; }
  Eigen::Index damping() const { return log_vs() + 2; }
  Eigen::Index inertia() const { return log_vs() + 3; }
  Eigen::Index size() const { return log_vs() + 4; }

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

/// Where a fit begins or ends. x: the law's linear parameters, as kv, kc, ks; ln vs, ln sigma0, sigma1, M.
struct LugrePoint {
  Eigen::VectorXd x;   // [l + 4]
  double squares = 0;  // sum of the squared residuals, each over its deviation
};

/// The values of law L's table at x.
template <typename L, typename T>
auto LugreValues(const T* x) {
  using std::exp;
  constexpr int vs = LevelsOf<L>();
  std::array<T, L::parameters.size()> values;
  std::copy_n(x, values.size(), values.begin());
  values[vs] = exp(x[vs]);
  values[vs + 1] = exp(x[vs + 1]);
  return values;
}

/// The same of a problem's law. [l + 3]
std::vector<double> LugreValuesAt(const LugreProblem& problem, const LugrePoint& point);

/// Points on a grid over sigma0 and sigma1: presliding distances d = ks / sigma0 from a quarter of
/// the shortest way between samples to the longest between turns, and sigma1 / sigma0 of 0, 1 and
/// 10 sampling intervals. steady(d): x up to ln vs of the samples that slide steadily then, nothing where
/// they do not tell. The inertia is what suits each best. Best first.
std::vector<LugrePoint> ScanBristle(
    const LugreProblem& problem, const LogSamples& measurements,
    const std::function<std::optional<Eigen::VectorXd>(double distance)>& steady);

/// A point with its fall from the level at rest replaced by others: vs at 16 values, even in ln vs
/// over three decades up to the fastest sample, each with the levels, the slope and the inertia that
/// suit it best: those of the point may have grown around a fall that is not there. Best first.
std::vector<LugrePoint> ScanFall(const LugreProblem& problem, const LugrePoint& point,
                                 double fastest);

struct LugreFit {
  LugrePoint solution;
  Eigen::VectorXd residual;   // [n] tau - F - M a, over the deviations
  Eigen::MatrixXd jacobian;   // [n x (l + 4)] of F + M a by x, over the deviations, exact
  std::vector<double> loads;  // [R] with which the recordings begin, N.m or N
  bool converged = false;
};

/// Minimises the sum of squares from a start by Levenberg-Marquardt.
LugreFit RefineLugre(const LugreProblem& problem, const LugrePoint& start);

/// F + M a at x over all samples of a problem whose recordings begin with `loads`. [N] N.m or N
Eigen::VectorXd LugreTorque(const LugreProblem& problem, const LugrePoint& point,
                            const std::vector<double>& loads);

}  // namespace warmjoint
