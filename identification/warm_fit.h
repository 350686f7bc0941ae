// Joint maximum likelihood of law and warming over the closed loop.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/closed_loop.h"

namespace warmjoint {

/// What is known of the initial energy.
enum class InitialEnergy { zero, estimated };

/// One iterate of the fit.
struct WarmIterate {
  Eigen::VectorXd x;   // [d + 2] law parameters, k, log(tau); [d + 3] with E(0)
  double squares = 0;  // sum of squared residuals over the kept samples
};

struct WarmFit {
  WarmIterate solution;
  Eigen::MatrixXd normal;  // J^T J at the solution, by x
  std::vector<WarmIterate> trace;
  bool converged = false;

  Thermal thermal() const;
  Eigen::VectorXd parameters() const;  // [d] of the law
  double initial_energy() const;
  Eigen::Index law_parameters = 0;  // d
};

/// Minimises the squared residuals of the kept samples by Ceres' Levenberg-Marquardt with exact
/// derivatives. Each evaluation is condensed: [J r] is replaced by a square factor R of the same
/// products, R^T R = [J r]^T [J r], so that Ceres sees d + 3 residuals in place of N and steps
/// exactly as it would on all of them.
/// level: [N] sign(v) torque; kept: [N] 1 or 0; parameters, thermal: the start;
/// scale: about the residuals' standard deviation, N.m or N.
WarmFit FitWarmFriction(const ClosedLoop& loop, const Eigen::VectorXd& level,
                        const Eigen::VectorXd& kept, const Eigen::VectorXd& parameters,
                        const Thermal& thermal, InitialEnergy initial_energy, double scale);

}  // namespace warmjoint
