// Nonlinear least squares by Ceres, with the derivatives at its end.
#pragma once

#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/sized_cost_function.h>
#include <ceres/solver.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace warmjoint {

/// Keeps what Ceres logs below fatal errors off stderr, from the first call on. A fit reports failures in its
/// status, so that the messages of Ceres are not needed.
void QuietCeres();

/// The point at which a minimisation ended.
template <int P>
struct CeresSolution {
  Eigen::VectorXd residuals;                                           // [n]
  Eigen::Matrix<double, Eigen::Dynamic, P, Eigen::RowMajor> jacobian;  // [n x P] by x, exact
  bool converged = false;
};

/// A cost that fails where a residual or a derivative is not a finite number. Ceres rejects the step after a failure
/// without a message, while it would write such numbers to stderr.
template <int P>
class FiniteCost final : public ceres::SizedCostFunction<ceres::DYNAMIC, P> {
 public:
  explicit FiniteCost(std::unique_ptr<ceres::CostFunction> cost) : cost_(std::move(cost)) {
    this->set_num_residuals(cost_->num_residuals());
  }

  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    const auto are_finite = [n = cost_->num_residuals()](const double* numbers, int columns) {
      return std::all_of(numbers, numbers + n * columns, [](double a) { return std::isfinite(a); });
    };
    if (!cost_->Evaluate(x, residuals, jacobians) || !are_finite(residuals, 1)) return false;
    return !jacobians || !jacobians[0] || are_finite(jacobians[0], P);
  }

 private:
  std::unique_ptr<ceres::CostFunction> cost_;
};

/// Minimises |residuals|^2 from x [P] by Levenberg-Marquardt with dense QR in at most 100
/// iterations; x becomes the minimum. cost: of one block of P parameters, x; constant: indices of
/// those that stay as they are. A start that is no finite number does not
/// converge.
template <int P>
CeresSolution<P> SolveByCeres(std::unique_ptr<ceres::CostFunction> cost,
                              const std::vector<int>& constant, double* x) {
  QuietCeres();
  ceres::Problem problem;
  auto* finite = new FiniteCost<P>(std::move(cost));  // owned by problem
  problem.AddResidualBlock(finite, nullptr, x);
  if (!constant.empty()) problem.SetManifold(x, new ceres::SubsetManifold(P, constant));

  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 100;
  options.function_tolerance = 1e-13;
  options.parameter_tolerance = 1e-11;
  options.gradient_tolerance = 1e-14;
  options.logging_type = ceres::SILENT;

  // Ceres writes to stderr of a start that it cannot evaluate
  const int n = finite->num_residuals();
  CeresSolution<P> solution;
  solution.residuals.setZero(n);
  solution.jacobian.setZero(n, P);
  const auto evaluate = [&, at = static_cast<const double*>(x)] {
    double* into = solution.jacobian.data();
    return finite->Evaluate(&at, solution.residuals.data(), &into);
  };
  if (!evaluate()) return solution;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);

  // residuals and derivatives at the solution
  solution.converged = evaluate() && summary.termination_type == ceres::CONVERGENCE &&
                       Eigen::Map<const Eigen::VectorXd>(x, P).allFinite();
  return solution;
}

}  // namespace warmjoint
