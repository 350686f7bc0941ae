// Nonlinear least squares by Ceres, with the derivatives at its end.
#pragma once

#include <ceres/cost_function.h>

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "identification/model/model_squares.h"

namespace warmjoint {

/// The point at which a minimisation ended.
struct CeresSolution {
  Eigen::VectorXd x;          // [p]
  Eigen::VectorXd residuals;  // [n]
  Eigen::MatrixXd jacobian;   // [n x p] of the residuals by x, exact
  bool converged = false;
};

/// Minimises |residuals|^2 from x [p] on by Levenberg-Marquardt with dense QR in at most 100
/// iterations. cost: of one block of p parameters; constant: indices of
/// those that stay as they are. A start that is no finite number does not converge. What Ceres logs below fatal errors stays off
/// stderr, from the first call on.
CeresSolution SolveByCeres(std::unique_ptr<ceres::CostFunction> cost,
                           const std::vector<int>& constant, Eigen::VectorXd x);

/// The residuals (f(x) - y) / scale of a model over the samples that count. model, samples: must outlive it; scale: about the torque's rms
std::unique_ptr<ceres::CostFunction> CostOf(const Model& model, const ModelSamples& samples,
                                            double scale);

}  // namespace warmjoint
