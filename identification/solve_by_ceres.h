// Nonlinear least squares by Ceres, with the derivatives at its end.
#pragma once

#include <ceres/cost_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <Eigen/Core>

namespace warmjoint {

/// Where a minimisation ended.
template <int P>
struct CeresSolution {
  Eigen::VectorXd residuals;                                           // [n]
  Eigen::Matrix<double, Eigen::Dynamic, P, Eigen::RowMajor> jacobian;  // [n x P] by x, exact
  bool converged = false;
};

/// Minimises |residuals|^2 from x [P] by Levenberg-Marquardt with dense QR in at most 100
/// iterations; x becomes the minimum. cost: of `problem` and of one block of P parameters, x.
template <int P>
CeresSolution<P> SolveByCeres(ceres::Problem& problem, const ceres::CostFunction& cost, double* x) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 100;
  options.function_tolerance = 1e-13;
  options.parameter_tolerance = 1e-11;
  options.gradient_tolerance = 1e-14;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);

  // residuals and derivatives at the solution
  const int n = cost.num_residuals();
  CeresSolution<P> solution{Eigen::VectorXd(n), {n, P}};
  const double* at = x;
  double* into = solution.jacobian.data();
  solution.converged = cost.Evaluate(&at, solution.residuals.data(), &into) &&
                       summary.termination_type == ceres::CONVERGENCE &&
                       Eigen::Map<const Eigen::VectorXd>(x, P).allFinite();
  return solution;
}

}  // namespace warmjoint
