// The colour of the noise, as the residual of a fit shows it.
#pragma once

#include <warmjoint/recording.h>

#include <Eigen/Core>
#include <functional>

namespace warmjoint {

/// Autoregressive noise e: e[i] + a_1 e[i-1] + ... + a_p e[i-p] = w[i], w white. White for p = 0.
struct NoiseModel {
  Eigen::VectorXd coefficients;  // [p] a
  Eigen::VectorXd covariances;   // [p + 1] of samples 0 to p apart; [1] or [0] for p = 0
  double variance = 0;           // of e, (N.m)^2 or N^2
  double innovation = 0;         // variance of w
  double correlation = 0;        // of neighbouring samples, -1 to 1
  /// By how much autocorrelation inflates the variance of an estimate of the noise's variance: at least 1.
  /// It is the sum over all lags of the squared autocorrelation.
  double variance_inflation = 1;

  Eigen::Index order() const { return coefficients.size(); }
};

/// Fits the order and the coefficients by Levinson's recursion (Durbin 1960) on the residual's
/// autocovariance, averaged over the pairs of samples that are both kept. The order is the one of
/// the smallest BIC; the search ends when 6 orders in a row do not better it, or at order 60.
/// residual: [n] over the kept samples; selection: their places. Neighbouring samples count
/// as one sampling interval apart.
NoiseModel FitNoise(const Eigen::VectorXd& residual, const Selection& selection);

/// Covariances of samples 0 to `last` apart, as the model continues them; 0 once they have died away
/// to 1e-6 of the variance. [last + 1]
Eigen::VectorXd CovariancesOf(const NoiseModel& noise, Eigen::Index last);

/// Whether the noise is coloured beyond doubt: the likelihood ratio n ln(variance / innovation) of
/// white noise would happen by chance, in the order that was chosen of 60, less often than five
/// deviations of a normal variable do. n: samples that the model was fitted to.
bool IsSurelyColoured(const NoiseModel& noise, Eigen::Index n);

/// A^T R A, where R is the covariance of the noise at the kept samples: the covariance of A^T e.
/// A: [n x d]. Exact for a stationary e: each column is filtered backwards through the inverse of
/// the model, beyond the first sample until it has died away.
Eigen::MatrixXd ScatterThrough(const NoiseModel& noise, const Eigen::MatrixXd& A,
                               const Selection& selection);

/// Of a matrix too large to hold its rows first <= i < last of the kept samples, [last - first x d].
using RowsBetween = std::function<Eigen::MatrixXd(Eigen::Index first, Eigen::Index last)>;

/// The same for such an A, of coloured noise. rows: of A.
Eigen::MatrixXd ScatterThrough(const NoiseModel& noise, const RowsBetween& rows, Eigen::Index d,
                               const Selection& selection);

}  // namespace warmjoint
