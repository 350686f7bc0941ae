#include "identification/uncertainty/penalised_uncertainty.h"

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

// why: from kernels that hardly go together to a wave over the whole of a coarse map, doubled
constexpr std::array<double, 4> kLengths{0.5, 1, 2, 4};  // kernels
// why 1e-9: of the largest variance; conditions on the weights leave a direction without any
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

/// w_found^T B w_found without what noise makes of it, but no less than its scatter by noise.
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

/// Weights that go together. by_left: [q x q] B L
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
/// s_w^2 counts each direction of the weights as much as its pull moves the fitted values, since the directions that
/// the data know well say nothing of how large those are that the prior holds back:
///     E w_found^T B w_found = s_w^2 tr (L^T B L R) + tr (B V).
/// Its scatter by noise, the square root of 2 tr (B V B V), joins in squares, so that a map that cannot be seen is not
/// reported as surely 0.
///
/// R is the identity, or the longest of those over 1/2, 1, 2 and 4 kernels up to which the weights become more likely,
///     w_found ~ N(0, s_w^2 L R L^T + V),
/// and the pull takes less from the fitted values, tr (B S); where it is more likely than independent weights at 1 %.
/// A map that is smooth from kernel to kernel loses less to the prior than one that is not. Empty or null `correlation`: the identity.
Eigen::MatrixXd PriorOfWeights(const PulledWeights& weights, const CorrelationOver& correlation) {
  // weights that go together with none
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
std::vector<Index> Drawn(const PenalisedFit& fit) {
  std::vector<Index> drawn;
  for (Index k = 0; k < fit.weights.size(); ++k) {
    if (!fit.unseen[static_cast<size_t>(k)]) drawn.push_back(fit.first + k);
  }
  return drawn;
}

/// Covariance of those weights before any data, s_w^2 R. drawn: [q] their places in x; hat: [d x d] C G;
/// pull: [d x q] s C_w; by_noise: [d x d] covariance from the noise.
Eigen::MatrixXd BeforeData(const PenalisedFit& fit, const std::vector<Index>& drawn,
                           const Eigen::MatrixXd& hat, const Eigen::MatrixXd& pull,
                           const Eigen::MatrixXd& by_noise) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(hat.rows());
  x.segment(fit.first, fit.weights.size()) = fit.weights;
  const Eigen::VectorXd found = x(drawn);
  const Eigen::MatrixXd bias = pull.transpose() * fit.gram * pull;
  const Eigen::MatrixXd left = hat(drawn, drawn), noise = by_noise(drawn, drawn);
  return PriorOfWeights({found, left, bias, noise}, fit.correlation);
}

}  // namespace

Uncertainty PenalisedCovariance(const PenalisedFit& fit, const RowsBetween& rows,
                                const Eigen::VectorXd& residual, const Selection& selection) {
  const Eigen::MatrixXd& C = fit.inverse;
  const auto n = static_cast<double>(residual.size());
  Uncertainty result;
  result.noise = FitNoise(residual, selection);
  const NoiseModel& noise = result.noise;

  // E|r|^2 = tr R - 2 tr(C S) + tr(C G C S), in samples of which at most half are taken up
  const Eigen::MatrixXd hat = C * fit.gram;
  const Eigen::MatrixXd spread =
      noise.order() == 0 ? Eigen::MatrixXd(noise.variance * hat)
                         : Eigen::MatrixXd(C * ScatterThrough(noise, rows, C.rows(), selection));
  const double product = hat.cwiseProduct(spread.transpose()).sum();
  const double taken = std::clamp((2 * spread.trace() - product) / noise.variance, 0.0, 0.5 * n);
  Eigen::MatrixXd by_noise(C.rows(), C.rows());
  by_noise.triangularView<Eigen::Lower>() = n / (n - taken) * spread * C;
  by_noise.triangularView<Eigen::StrictlyUpper>() = by_noise.transpose();

  // what the prior pulls away
  const std::vector<Index> drawn = Drawn(fit);
  const Eigen::MatrixXd pull = fit.strength * C(Eigen::all, drawn);
  const Eigen::MatrixXd by_pull = pull * BeforeData(fit, drawn, hat, pull, by_noise);
  by_noise.triangularView<Eigen::Lower>() += by_pull * pull.transpose();
  by_noise.triangularView<Eigen::StrictlyUpper>() = by_noise.transpose();
  // what was known beforehand errs as a measurement of that weight does
  if (fit.prior.size() > 0) {
    by_noise += noise.variance * (C * fit.prior.asDiagonal() * C);
  }
  result.covariance = std::move(by_noise);
  // independent samples less effective parameters
  result.degrees_of_freedom = std::max(n / noise.variance_inflation - hat.trace(), 1.0);
  return result;
}

}  // namespace warmjoint
