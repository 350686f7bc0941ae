// Least squares of the LuGre law over a recorded motion, by Ceres.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "models/friction/lugre.h"
#include "models/recording/measurements.h"
#include "models/recording/selection.h"

namespace warmjoint::inline identification {

/// Where the LuGre parameters and the inertia stand in x.
enum LugreIndex : Eigen::Index {
  kLugreViscous,
  kLugreCoulomb,
  kLugreStatic,
  kLugreLogVs,
  kLugreLogStiffness,
  kLugreDamping,
  kLugreInertia,
  kLugreSize
};

/// tau = F + M a over the samples of `used`. The bristle runs over all samples; how it is bent as
/// each recording begins is estimated beside x (lugre_course.h).
struct LugreProblem {
  MotionPieces motion;           // of the N samples
  Eigen::VectorXd acceleration;  // [N] rad/s^2 or m/s^2
  Eigen::VectorXd torque;        // [N] N.m or N
  Selection used;                // samples of the fit
  Eigen::VectorXd deviation;     // [n] of each one's noise, N.m or N
  std::vector<int> constant;     // parameters of x that stay as they are

  bool IsConstant(int parameter) const {
    return std::count(constant.begin(), constant.end(), parameter) > 0;
  }
  /// One past the last sample of the recording that begins at `first`.
  Eigen::Index EndOfRecording(Eigen::Index first) const {
    Eigen::Index end = first + 1;
    while (end < motion.size() && !motion.Begins(end)) ++end;
    return end;
  }
};

/// Where a fit begins or ends. x: kv, kc, ks, ln vs, ln sigma0, sigma1, M.
struct LugrePoint {
  Eigen::Matrix<double, kLugreSize, 1> x;
  double squares = 0;  // sum of the squared residuals, each over its deviation
};

/// The six values of the law's table at x.
template <typename T>
std::array<T, 6> LugreValues(const T* x) {
  using std::exp;
  return {x[kLugreViscous],    x[kLugreCoulomb],           x[kLugreStatic],
          exp(x[kLugreLogVs]), exp(x[kLugreLogStiffness]), x[kLugreDamping]};
}

/// Points on a grid over sigma0 and sigma1: presliding distances d = ks / sigma0 from a quarter of
/// the shortest way between samples to the longest between turns, and sigma1 / sigma0 of 0, 1 and
/// 10 sampling intervals. steady(d): {kv, kc, ks, ln vs} of the samples that slide steadily then,
/// nothing where they do not tell. The inertia is what suits each best. Best first.
std::vector<LugrePoint> ScanBristle(
    const LugreProblem& problem, const Measurements& measurements,
    const std::function<std::optional<Eigen::Vector4d>(double distance)>& steady);

/// A point with its fall from static to coulomb replaced by others: vs at 16 values, even in ln vs
/// over three decades up to the fastest sample, each with the levels, the slope and the inertia that
/// suit it best: those of the point may have grown around a fall that is not there. Best first.
std::vector<LugrePoint> ScanFall(const LugreProblem& problem, const LugrePoint& point,
                                 double fastest);

struct LugreFit {
  LugrePoint solution;
  Eigen::VectorXd residual;   // [n] tau - F - M a, over the deviations
  Eigen::MatrixXd jacobian;   // [n x kLugreSize] of F + M a by x, over the deviations, exact
  std::vector<double> loads;  // [R] with which the recordings begin, N.m or N
  bool converged = false;
};

/// Minimises the sum of squares from a start by Levenberg-Marquardt.
LugreFit RefineLugre(const LugreProblem& problem, const LugrePoint& start);

/// F + M a at x over all samples of a problem whose recordings begin with `loads`. [N] N.m or N
Eigen::VectorXd LugreTorque(const LugreProblem& problem, const LugrePoint& point,
                            const std::vector<double>& loads);

}  // namespace warmjoint::inline identification
