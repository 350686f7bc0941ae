// How strong and how long fields are, by the marginal likelihood of a log with autocorrelated noise.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "identification/fields/field_block.h"

namespace warmjoint {

/// What fields and noise depend on.
struct FieldHyperparameters {
  std::vector<double> amplitudes;  // [k] shares of the friction; 0: nothing is there
  std::vector<size_t> lengths;     // [k] which of the block's
  double correlation = 0;          // rho of the noise from one row to the next
  double innovation = 1;           // s^2, the variance of what is new in each row, (N.m)^2 or N^2
};

/// Unknowns x = (flat columns, fields) with their covariance.
struct FieldPosterior {
  Eigen::VectorXd mean;        // [p + m]
  Eigen::MatrixXd covariance;  // [p + m]^2
};

/// A log's rows, y = A x + e, e autoregressive of first order within runs of neighbours:
///
///     G(rho) = (1 - rho^2) G_f + G_i + rho^2 G_p - rho (G_x + G_x^T)
///
/// with the Gram matrices of [A y] over the first rows of runs, the other rows, the rows before these, and of both. The marginal
/// likelihood is that of x ~ N(0, P^-1), wide for flat columns:
///
///     -2 log p = n log s^2 - runs log(1 - rho^2) + y^T y/s^2 - b^T H^-1 b + log|H| - log|P| + sum (amplitude/scale)^2,
///     H = A^T A/s^2 + P, b = A^T y/s^2.
class FieldEvidence {
 public:
  /// friction: N.m or N, of which amplitudes are shares. rows and blocks must outlive this.
  FieldEvidence(const FieldRows& rows, const std::vector<FieldBlock>& blocks, double friction);

  /// The most likely ones, found one after the other: correlation and innovation by a grid, then each field's length and amplitude
  /// given all else, in rounds until nothing changes.
  FieldHyperparameters Maximise() const;
  /// -2 log p of the rows and of the amplitudes, up to a constant.
  double Cost(const FieldHyperparameters& at) const;
  /// The posterior for some hyperparameters.
  FieldPosterior At(const FieldHyperparameters& at) const;
  /// Mean and covariance over hyperparameters drawn by their posterior (griddy Gibbs, Ritter and Tanner 1992), with the same draws for
  /// the same log. An amplitude is 0 with a probability of a tenth beforehand, else half-normal.
  FieldPosterior Averaged(const FieldHyperparameters& start) const;
  /// By how much the covariance is larger since the noise is not quite of first order: 1 + 2 sum of the correlations of what is left of
  /// the residual, at least 1.
  double LeftCorrelation(const FieldHyperparameters& at, const Eigen::VectorXd& mean) const;
  /// Trace of the hat matrix.
  double EffectiveParameters(const FieldHyperparameters& at) const;

  Eigen::Index flat() const { return flat_; }
  /// Where a block's unknowns begin.
  Eigen::Index Begin(size_t block) const { return begins_[block]; }
  Eigen::Index size() const { return size_; }

 private:
  class Search;
  Eigen::MatrixXd GramAt(double correlation) const;
  /// The part of the cost that depends on the noise. gram: GramAt(correlation); prior: PriorAt
  double CostOfNoise(const Eigen::MatrixXd& gram, const Eigen::MatrixXd& prior, double correlation,
                     double innovation) const;
  /// b. [p + m]
  Eigen::VectorXd ProductAt(const Eigen::MatrixXd& gram, double innovation) const;
  Eigen::MatrixXd PriorAt(const FieldHyperparameters& at) const;

  const FieldRows& rows_;
  const std::vector<FieldBlock>& blocks_;
  double friction_;
  Eigen::Index flat_ = 0, size_ = 0, runs_ = 0;     // p, p + m
  std::vector<double> correlations_;                // that the noise may have, ascending
  std::vector<Eigen::Index> begins_;                // [k]
  Eigen::MatrixXd first_, inner_, before_, cross_;  // [p + m + 1]^2
  Eigen::MatrixXd flat_precision_;                  // [p x p] of the priors
  Eigen::VectorXd flat_product_;                    // [p] of these times their means
  std::vector<std::vector<Eigen::MatrixXd>> roots_, inverses_;  // [k][l] of the kernels
  std::vector<std::vector<double>> log_determinants_;
};

}  // namespace warmjoint
