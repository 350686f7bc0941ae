#include "identification/kalman_step.h"

#include <cmath>

namespace warmjoint {
namespace {

/// Takes in sign(v) tau. The state enters it linearly.
void Correct(const KalmanSample& sample, double variance, KalmanState& state) {
  const Eigen::Index d = sample.levels.size();
  Eigen::VectorXd row = Eigen::VectorXd::Zero(d + 3);
  row.head(d) = sample.levels;
  row[d + 2] = 1;
  const Eigen::VectorXd Pa = state.covariance * row;
  const double scale = 1 / (variance + row.dot(Pa));
  const double innovation = sample.level - row.dot(state.mean);
  state.mean += (scale * innovation) * Pa;
  state.covariance -= scale * Pa * Pa.transpose();
}

/// Moves on by one interval.
void Predict(const KalmanSample& sample, const Eigen::VectorXd& drift, KalmanState& state) {
  const Eigen::Index d = sample.levels.size();
  const double gain = state.mean[d];
  const double a = sample.step / std::exp(state.mean[d + 1]);
  const double pole = std::exp(-a);
  const double cooling = -std::expm1(-a);
  const double energy = state.mean[d + 2];
  const double loss = sample.speed * (sample.levels.dot(state.mean.head(d)) + energy);

  // the row of E in the Jacobian; all others are those of the identity
  Eigen::VectorXd row(d + 3);
  row.head(d) = gain * cooling * sample.speed * sample.levels;
  row[d] = cooling * loss;
  row[d + 1] = a * pole * (energy - gain * loss);
  row[d + 2] = pole + gain * cooling * sample.speed;

  const Eigen::VectorXd cross = state.covariance * row;
  state.covariance.row(d + 2) = cross.transpose();
  state.covariance.col(d + 2) = cross;
  state.covariance(d + 2, d + 2) = row.dot(cross);
  state.mean[d + 2] = pole * energy + gain * cooling * loss;
  state.covariance.diagonal() += sample.step * drift;
}

}  // namespace

KalmanState KalmanStep(const KalmanState& state, const KalmanSample& sample,
                       const KalmanNoise& noise) {
  KalmanState next = state;
  if (sample.measured) Correct(sample, noise.torque, next);
  Predict(sample, noise.drift, next);
  return next;
}

}  // namespace warmjoint
