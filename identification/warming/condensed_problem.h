// Warm friction's least squares over N samples, condensed to as many residuals as parameters.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/warming/warm_fit.h"

namespace warmjoint {

/// What pulls E(0) to its expected value: weight (E(0) - mean)^2 beside the squared residuals.
struct StartPull {
  double mean = 0;    // N.m or N
  double weight = 0;  // of one squared residual
};

/// The condensed least-squares problem, as ceres::TinySolver wants it, over law parameters (d), k, log tau, E(0) where
/// it is estimated, jumps of E (J) and offsets (q). What is summed over the samples is compiled for each size of the
/// common laws; all else has its sizes at run time.
class CondensedProblem {
 public:
  using Scalar = double;
  enum { NUM_PARAMETERS = Eigen::Dynamic, NUM_RESIDUALS = Eigen::Dynamic };

  /// warming: 2 for (k, log tau), 3 with E(0); jump_weights: [J] what each jump's square counts beside the squared
  /// residuals; pull: on E(0), where it is estimated; transform: of the rows, in the order of the samples that count;
  /// or none. The references are to outlive the problem.
  CondensedProblem(const ClosedLoop& loop, const Eigen::VectorXd& level,
                   const Eigen::MatrixXd& offsets, const Eigen::VectorXd& kept,
                   const Eigen::VectorXd& jump_weights, int warming, const StartPull& pull,
                   double scale, const RowTransform* transform = nullptr);

  int NumParameters() const { return static_cast<int>(x_.size()); }
  int NumResiduals() const { return NumParameters() + 1; }

  /// A square factor R of the products, R^T R = [J r]^T [J r] / scale^2: its last column is the residuals [p + 1], the
  /// others the jacobian [p + 1 x p], where one is asked for.
  bool operator()(const double* x, double* residuals, double* jacobian) const;

  /// [J r]^T [J r] at x, r = measured - modelled level. [p + 1 x p + 1]
  const Eigen::MatrixXd& Evaluate(const Eigen::VectorXd& x) const;

  std::vector<WarmIterate>& trace() const { return trace_; }

 private:
  /// Sums the products over the samples at x_. D: law parameters, or Dynamic, which jumps and offsets need; Q: warming.
  template <int D, int Q>
  void SumProducts() const;
  void SumProductsOfSize() const;

  /// The products of the mapped rows. The map is one of torque: rows of the level change
  /// their sign with the direction.
  template <typename FillRows>
  Eigen::MatrixXd TransformedProducts(const FillRows& fill) const;

  /// Sets the row [-da/dx, r] of sample n from the derivatives g [d] and S [d + 3 + J] of closed_loop_kernel.h.
  template <int D, int Q, typename Row>
  void Fill(Eigen::Index n, double residual, const double* g, const double* S, Row row) const;

  /// Adds the row sqrt(w) [-1, -b] of parameter i, which lies b from what it is known for but for its
  /// spread.
  void AddKnown(Eigen::Index i, double w, double b) const;

  const ClosedLoop& loop_;
  const Eigen::VectorXd& level_;
  const Eigen::MatrixXd& offsets_;
  Eigen::VectorXd weight_;        // [N] of each row, the root of its square's
  Eigen::VectorXd jump_weights_;  // [J]
  int warming_;
  StartPull pull_;
  double scale_;
  const RowTransform* transform_;
  Eigen::Index d_;

  // the latest evaluation: Ceres asks for the residuals at a point, then for the derivatives there
  mutable Eigen::VectorXd x_;         // [p]
  mutable Eigen::VectorXd measured_;  // [N] level less what the offsets explain
  mutable Eigen::MatrixXd products_;  // [p + 1 x p + 1]
  mutable std::vector<WarmIterate> trace_;
};

}  // namespace warmjoint
