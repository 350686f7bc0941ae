// The least squares of a model: the one solver for models that are fitted to a log by their derivatives.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace warmjoint {

/// A point, and how well it fits.
struct FitPoint {
  Eigen::VectorXd x;   // [p]
  double squares = 0;  // sum of squared residuals over the samples that count
};

/// Rows of a least-squares problem at a point x, summed, over the variance of the noise: J the derivatives of the model, r what it
/// leaves of the data. What is known in addition to the data counts as rows, too.
struct RowSums {
  Eigen::MatrixXd gram;     // [p x p] J^T J
  Eigen::VectorXd product;  // [p] J^T r, minus half the slope of the squares
  double squares = 0;       // r^T r
};

/// What is minimised, and within which limits. Empty limits: none.
struct SquaresProblem {
  std::function<RowSums(const Eigen::VectorXd& x)> sums{};
  Eigen::VectorXd lower{}, upper{};  // [p] of x
  Eigen::VectorXd largest_step{};    // [p] in one iteration
  std::vector<Eigen::Index> held{};  // unknowns that stay as they are
  /// The step from x of gram step = product, where it must keep conditions; empty: by SolveScaled.
  std::function<Eigen::VectorXd(const Eigen::MatrixXd& gram, const Eigen::VectorXd& product,
                                const Eigen::VectorXd& x)>
      step{};
  int most_iterations = 50;
  /// Predicted fall of the squares by the next step, in variances of the noise, at which a fit has converged: no unknown is
  /// farther from the minimum than its root, in standard deviations.
  double rests = 1e-10;
  /// Squares that the rounding of the data leaves of an exact fit, which no step lowers.
  double least = 0;
};

struct Minimum {
  Eigen::VectorXd x;                   // [p]
  RowSums sums;                        // at x
  std::vector<FitPoint> trace;         // all iterates, the last is x
  std::vector<Eigen::Index> at_bound;  // unknowns that the squares push against their bounds
  double fell = 0;                     // the squares in the last iteration
  bool converged = false;
};

/// From x on by Gauss-Newton's steps, damped as Levenberg and Marquardt do (SIAM J. Appl. Math. 11, 1963) where one does not
/// lower the squares. Unknowns at a bound that the squares push outwards stay there. It has not converged where squares,
/// gram, product or step are not finite, or where the squares do not fall although the steps predict it.
Minimum Minimise(const SquaresProblem& problem, Eigen::VectorXd x);

}  // namespace warmjoint
