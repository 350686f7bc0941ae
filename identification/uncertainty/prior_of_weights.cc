#include "identification/uncertainty/prior_of_weights.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "identification/uncertainty/tails.h"

namespace warmjoint::inline identification {
namespace {

// why: from kernels that hardly go together to a wave over the whole of a coarse map, doubled
constexpr std::array<double, 4> kLengths{0.5, 1, 2, 4};  // kernels
// why 1e-9: of the largest variance; conditions on the weights leave a direction without any
constexpr double kFloor = 1e-9;

/// A covariance of weights before any data.
struct Candidate {
  Eigen::MatrixXd covariance;  // [q x q] s_w^2 R
  double deviance = 0;         // minus twice the logarithm of the likelihood of what was found
  double pull = 0;             // what the prior's pull takes from the fitted values, squared
};

/// w_found^T B w_found without what noise makes of it, but no less than its scatter by noise.
double TakenByPull(const PulledWeights& weights) {
  const Eigen::MatrixXd noise = weights.bias * weights.noise;
  const double seen = weights.found.dot(weights.bias * weights.found) - noise.trace();
  const double scatter = std::sqrt(2 * noise.cwiseProduct(noise.transpose()).sum());
  return std::hypot(std::max(seen, 0.0), scatter);
}

/// -2 log of the likelihood of w_found under a covariance before any data, but for a constant.
double Deviance(const PulledWeights& weights, const Eigen::MatrixXd& covariance) {
  const Eigen::MatrixXd half = weights.left * covariance;
  Eigen::MatrixXd of_found = weights.noise;
  of_found.triangularView<Eigen::Lower>() += half * weights.left.transpose();
  of_found.diagonal().array() += kFloor * of_found.diagonal().maxCoeff();
  const Eigen::LLT<Eigen::MatrixXd> factors(of_found);
  if (factors.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
  const Eigen::VectorXd root = factors.matrixLLT().diagonal();
  return factors.matrixL().solve(weights.found).squaredNorm() + 2 * root.array().log().sum();
}

}  // namespace

Eigen::MatrixXd PriorOfWeights(const PulledWeights& weights, const CorrelationOver& correlation) {
  const Eigen::Index q = weights.found.size();
  const Eigen::MatrixXd of_left = weights.left.transpose() * weights.bias * weights.left;
  const double taken = TakenByPull(weights);
  const auto scaled = [&](const Eigen::MatrixXd& alike) -> Eigen::MatrixXd {
    const double expected = of_left.cwiseProduct(alike).sum();
    return (expected > 0 ? taken / expected : 0) * alike;
  };
  Eigen::MatrixXd independent = scaled(Eigen::MatrixXd::Identity(q, q));
  if (!correlation || q == 0) return independent;

  // longer ones, as long as the weights become more likely and the pull takes less
  const auto judged = [&](Eigen::MatrixXd covariance) {
    const double deviance = Deviance(weights, covariance);
    const double pull = weights.bias.cwiseProduct(covariance).sum();
    return Candidate{std::move(covariance), deviance, pull};
  };
  const Candidate apart = judged(std::move(independent));
  Candidate best = apart;
  for (const double length : kLengths) {
    Candidate longer = judged(scaled(correlation(length)));
    if (!(longer.deviance < best.deviance && longer.pull < best.pull)) break;
    best = std::move(longer);
  }
  return best.deviance < apart.deviance - kNoChance ? best.covariance : apart.covariance;
}

}  // namespace warmjoint::inline identification
