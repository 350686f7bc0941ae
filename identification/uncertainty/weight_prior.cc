#include "identification/uncertainty/weight_prior.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "identification/uncertainty/tails.h"

namespace warmjoint {
namespace {

using Eigen::Index;

// why: from hardly correlated kernels to a wave over the whole of a coarse map, doubled each time
constexpr std::array<double, 4> kLengths{0.5, 1, 2, 4};  // kernels
// why 1e-9: of the largest variance; conditions on the weights leave a direction without variance
constexpr double kFloor = 1e-9;

/// Weights that a prior pulls towards 0, w_found = L w + noise.
struct PulledWeights {
  const Eigen::VectorXd& found;  // [q]
  const Eigen::MatrixXd& left;   // [q x q] L, what the prior leaves of w
  const Eigen::MatrixXd& bias;   // [q x q] B: w^T B w is what the pull takes from the fit, squared
  const Eigen::MatrixXd& noise;  // [q x q] V, covariance of w_found by noise
};

/// A covariance s_w^2 R of the weights before any data.
struct Candidate {
  double variance = 0;          // s_w^2
  Eigen::MatrixXd correlation;  // [q x q] R
  double deviance = 0;          // minus twice the logarithm of the likelihood of what was found
  double pull = 0;  // tr (B s_w^2 R), what the prior's pull takes from the fitted values
};

/// w_found^T B w_found without the part that noise makes, but no less than its scatter by noise.
double TakenByPull(const PulledWeights& weights) {
  const Eigen::MatrixXd noise = weights.bias * weights.noise;
  const double seen = weights.found.dot(weights.bias * weights.found) - noise.trace();
  const double scatter = std::sqrt(2 * noise.cwiseProduct(noise.transpose()).sum());
  return std::hypot(std::max(seen, 0.0), scatter);
}

/// The variance that takes as much from the fitted values as was seen. expected: tr (L^T B L R)
double VarianceOf(double taken, double expected) { return expected > 0 ? taken / expected : 0; }

/// -2 log of the likelihood of w_found, but for a constant. variance: s_w^2; spread: [q x q] L R L^T, whose lower half
/// is read.
double Deviance(const PulledWeights& weights, double variance, const Eigen::MatrixXd& spread) {
  Eigen::MatrixXd of_found = weights.noise + variance * spread;
  of_found.diagonal().array() += kFloor * of_found.diagonal().maxCoeff();
  const Eigen::LLT<Eigen::MatrixXd> factors(of_found);
  if (factors.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
  const Eigen::VectorXd root = factors.matrixLLT().diagonal();
  return factors.matrixL().solve(weights.found).squaredNorm() + 2 * root.array().log().sum();
}

/// The candidate of correlated weights. by_left: [q x q] B L
Candidate Together(const PulledWeights& weights, double taken, const Eigen::MatrixXd& by_left,
                   Eigen::MatrixXd correlation) {
  const Eigen::MatrixXd half = weights.left * correlation;
  Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(half.rows(), half.cols());
  spread.triangularView<Eigen::Lower>() = half * weights.left.transpose();
  const double variance = VarianceOf(taken, half.cwiseProduct(by_left).sum());
  const double pull = variance * weights.bias.cwiseProduct(correlation).sum();
  return {variance, std::move(correlation), Deviance(weights, variance, spread), pull};
}

/// Covariance s_w^2 R of the weights before any data. [q x q]
///
/// s_w^2 counts each direction of the weights as much as the prior's pull on it changes the fitted values, since the directions
/// that the data determine well show nothing of the size of those that the prior holds back:
///     E w_found^T B w_found = s_w^2 tr (L^T B L R) + tr (B V).
/// Its scatter by noise, the square root of 2 tr (B V B V), is added in squares, so that a map that cannot be seen is not
/// reported as exactly 0.
///
/// R is the identity, or the longest of those over 1/2, 1, 2 and 4 kernels up to which the weights become more likely,
///     w_found ~ N(0, s_w^2 L R L^T + V),
/// and the pull takes less from the fitted values, tr (B S); where it is more likely than independent weights at 1 %.
/// A map that is smooth from kernel to kernel loses less to the prior than one that is not. Empty or null `correlation`: the identity.
Eigen::MatrixXd PriorOfWeights(const PulledWeights& weights, const CorrelationOver& correlation) {
  // independent weights
  const double taken = TakenByPull(weights);
  const Eigen::MatrixXd by_left = weights.bias * weights.left;
  const Index q = weights.found.size();
  Candidate apart{0, Eigen::MatrixXd::Identity(q, q), 0, 0};
  apart.variance = VarianceOf(taken, weights.left.cwiseProduct(by_left).sum());
  apart.pull = apart.variance * weights.bias.trace();
  if (!correlation || q == 0) return apart.variance * apart.correlation;
  Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(q, q);
  spread.selfadjointView<Eigen::Lower>().rankUpdate(weights.left);
  apart.deviance = Deviance(weights, apart.variance, spread);

  // longer ones, as long as the weights become more likely and the pull takes less
  Candidate best = apart;
  for (const double length : kLengths) {
    Candidate longer = Together(weights, taken, by_left, correlation(length));
    if (!(longer.deviance < best.deviance && longer.pull < best.pull)) break;
    best = std::move(longer);
  }
  // a correlation must be more likely by more than chance
  const Candidate& chosen = best.deviance < apart.deviance - kNoChance ? best : apart;
  return chosen.variance * chosen.correlation;
}

/// Places in x of the weights that are drawn from the prior.
std::vector<Index> Drawn(const WeightPrior& prior) {
  std::vector<Index> drawn;
  for (Index k = 0; k < prior.weights.size(); ++k) {
    if (!prior.unseen[static_cast<size_t>(k)]) drawn.push_back(prior.first + k);
  }
  return drawn;
}

}  // namespace

Eigen::MatrixXd CovarianceByPull(const WeightPrior& prior, const Eigen::MatrixXd& cofactor,
                                 const Eigen::MatrixXd& hat, const Eigen::MatrixXd& by_noise) {
  const std::vector<Index> drawn = Drawn(prior);
  const Eigen::MatrixXd pull = prior.strength * cofactor(Eigen::all, drawn);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(hat.rows());
  x.segment(prior.first, prior.weights.size()) = prior.weights;
  const Eigen::VectorXd found = x(drawn);
  const Eigen::MatrixXd bias = pull.transpose() * prior.gram * pull;
  const Eigen::MatrixXd left = hat(drawn, drawn), noise = by_noise(drawn, drawn);
  return pull * PriorOfWeights({found, left, bias, noise}, prior.correlation) * pull.transpose();
}

}  // namespace warmjoint
