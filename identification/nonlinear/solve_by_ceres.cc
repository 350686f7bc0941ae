#include "identification/nonlinear/solve_by_ceres.h"

#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace warmjoint {
namespace {

using RowMajor = ModelRows::Rows;

/// A glog that is quiet below fatal errors: a fit reports failures in its status.
void QuietCeres() {
  // glog reads its level unguarded: set once, before the first fit of any thread
  [[maybe_unused]] static const int level =
      (FLAGS_minloglevel = std::max(FLAGS_minloglevel, google::GLOG_FATAL));
}

/// A cost that fails where a residual or a derivative is not a finite number. Ceres rejects the step after a failure
/// without a message, while it would write such numbers to stderr.
class FiniteCost final : public ceres::CostFunction {
 public:
  explicit FiniteCost(std::unique_ptr<ceres::CostFunction> cost) : cost_(std::move(cost)) {
    set_num_residuals(cost_->num_residuals());
    *mutable_parameter_block_sizes() = cost_->parameter_block_sizes();
  }

  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    const auto are_finite = [n = cost_->num_residuals()](const double* numbers, int columns) {
      return std::all_of(numbers, numbers + n * columns, [](double a) { return std::isfinite(a); });
    };
    if (!cost_->Evaluate(x, residuals, jacobians) || !are_finite(residuals, 1)) return false;
    return !jacobians || !jacobians[0] || are_finite(jacobians[0], parameter_block_sizes()[0]);
  }

 private:
  std::unique_ptr<ceres::CostFunction> cost_;
};

/// CostOf.
class ModelCost final : public ceres::CostFunction {
 public:
  ModelCost(const Model& model, const ModelSamples& samples, double scale)
      : model_(model), samples_(samples), scale_(scale) {
    set_num_residuals(static_cast<int>(samples.keep.count()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(model.size()));
  }

  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    const Eigen::Index n = num_residuals(), p = model_.size();
    const Eigen::Map<const Eigen::VectorXd> at(x[0], p);
    const RowMajor rows = RowsToFit(ModelAt(model_, at), samples_);
    Eigen::Map<Eigen::VectorXd>(residuals, n) = rows.col(p) / -scale_;
    if (jacobians && jacobians[0]) {
      Eigen::Map<RowMajor>(jacobians[0], n, p) = rows.leftCols(p) / scale_;
    }
    return true;
  }

 private:
  const Model& model_;
  const ModelSamples& samples_;
  double scale_;
};

}  // namespace

CeresSolution SolveByCeres(std::unique_ptr<ceres::CostFunction> cost,
                           const std::vector<int>& constant, Eigen::VectorXd x) {
  QuietCeres();
  ceres::Problem problem;
  auto* finite = new FiniteCost(std::move(cost));  // owned by problem
  problem.AddResidualBlock(finite, nullptr, x.data());
  const auto p = static_cast<int>(x.size()), n = finite->num_residuals();
  if (!constant.empty()) problem.SetManifold(x.data(), new ceres::SubsetManifold(p, constant));

  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 100;
  options.function_tolerance = 1e-13;
  options.parameter_tolerance = 1e-11;
  options.gradient_tolerance = 1e-14;
  options.logging_type = ceres::SILENT;

  // Ceres writes to stderr of a start that it cannot evaluate
  CeresSolution solution;
  solution.residuals.setZero(n);
  RowMajor jacobian = RowMajor::Zero(n, p);
  const auto evaluate = [&] {
    const double* at = x.data();
    double* into = jacobian.data();
    return finite->Evaluate(&at, solution.residuals.data(), &into);
  };
  if (evaluate()) {
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    solution.converged =
        evaluate() && summary.termination_type == ceres::CONVERGENCE && x.allFinite();
  }
  solution.jacobian = jacobian;
  solution.x = std::move(x);
  return solution;
}

std::unique_ptr<ceres::CostFunction> CostOf(const Model& model, const ModelSamples& samples,
                                            double scale) {
  return std::make_unique<ModelCost>(model, samples, scale);
}

}  // namespace warmjoint
