// The fit of a model to samples, whose noise is known or not.
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
  Eigen::MatrixXd gram;      // [P x P] J^T J at x
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

/// Variance about 0 and autocorrelation time of a residual's kept samples. e: [n]
NoiseScale NoiseScaleOf(const Eigen::VectorXd& e);

}  // namespace warmjoint
