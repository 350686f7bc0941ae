// The fit of a model to samples whose noise is not known, and the covariance of its unknowns.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/model/least_squares.h"
#include "identification/model/minimise.h"
#include "identification/model/model.h"
#include "identification/model/model_squares.h"

namespace warmjoint {

/// The information in a sample: 1 / (variance x autocorrelation time).
struct NoiseScale {
  double variance = 1;
  double correlation = 1;  // samples: 1 + 2 sum of the autocorrelations until they fall below 0.05

  double scale() const { return variance * correlation; }
};

struct SolvedModel {
  Eigen::VectorXd x;         // [P]
  Eigen::VectorXd residual;  // [N] torque - force
  NoiseScale noise;
  std::vector<Eigen::Index> at_bound;  // unknowns that are held at theirs
  bool converged = false;
  int iterations = 0;
};

/// The limits of a table's unknowns, and when a fit of them rests: no unknown is farther from the minimum than 1 % of its
/// standard deviation. held: unknowns that stay as they are.
SquaresProblem WithinLimits(const Model& model, const std::vector<Eigen::Index>& held = {});

/// Least squares weighted by the noise, whose scale follows from the residual, plus the priors, from x on, within the bounds. held: unknowns
/// that stay as they are.
SolvedModel Solve(const Model& model, const ModelSamples& samples, Eigen::VectorXd x,
                  const std::vector<Eigen::Index>& held = {});

/// The same where the variance of the noise is known, to the last digits (SquaresProblem::rests), from x on.
Minimum SolveAtNoise(const Model& model, const ModelSamples& samples, double variance,
                     Eigen::VectorXd x);

struct LinearMinimum {
  LeastSquares solved;
  double squares = 0;  // that are left; of columns that can be distinguished
};

/// The least squares of a model that is linear in its unknowns and has no priors.
LinearMinimum SolveLinear(const Model& model, const ModelSamples& samples);

struct SolvedCovariance {
  Eigen::MatrixXd covariance;     // [P x P] of x
  double degrees_of_freedom = 1;  // of Student's quantile: blocks of time less 1
  double effective_parameters = 0;
  double block = 0;  // s
};

/// Sandwich H^-1 (sum over blocks of time of (J^T e)(J^T e)^T B / (B - 1) + prior) H^-1, H = J^T J / scale + prior. Blocks last
/// four times the residual's correlation, .5 s at least and a twentieth of the log at most.
SolvedCovariance CovarianceOf(const Model& model, const ModelSamples& samples,
                              const SolvedModel& solved);

/// The scatter of rows between blocks of time.
struct BlockScatter {
  Eigen::MatrixXd
      squares;  // [p x p] sum over the blocks of s s^T, s the sum of a block's rows, times B / (B - 1)
  double blocks = 0;  // B
};
/// rows: [n x p]; time: [n] s; blocks of `length`, s, from `origin` on
BlockScatter ScatterOverBlocks(const Eigen::MatrixXd& rows, const Eigen::VectorXd& time,
                               double origin, double length);

/// Variance about 0 and autocorrelation time of a residual's kept samples. e: [n]
NoiseScale NoiseScaleOf(const Eigen::VectorXd& e);

}  // namespace warmjoint
