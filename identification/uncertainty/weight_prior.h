// The error of a fit by the pull of a prior on the weights of maps.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace warmjoint {

/// [q x q] correlation R of weights that are correlated over `length` kernels; the identity for 0.
using CorrelationOver = std::function<Eigen::MatrixXd(double length)>;

/// The prior s |w|^2 of a fit x = argmin |y - f(x)|^2 + s |w|^2 + ..., w those of a run of entries of x that the data say
/// something about.
struct WeightPrior {
  Eigen::MatrixXd gram;     // [d x d] G = J^T J, without any prior
  Eigen::Index first = 0;   // place of w in x
  Eigen::VectorXd weights;  // [q] w
  double strength = 0;      // s
  /// [q] weights that follow their neighbours and are not drawn from the prior
  std::vector<bool> unseen;
  CorrelationOver correlation{};  // of the weights that are not unseen
};

/// Covariance of the errors of x by the prior's pull, s^2 C_w S C_w^T, C_w the columns of C at the weights, S their covariance before
/// any data (PriorOfWeights). Of the weights L = (C G)_ww is found, their pull takes B = s^2 C_w^T G C_w from the fitted values, and
/// V is their noise. cofactor: [d x d] C; hat: [d x d] C G; by_noise: [d x d] covariance by the noise; returns [d x d]
Eigen::MatrixXd CovarianceByPull(const WeightPrior& prior, const Eigen::MatrixXd& cofactor,
                                 const Eigen::MatrixXd& hat, const Eigen::MatrixXd& by_noise);

}  // namespace warmjoint
