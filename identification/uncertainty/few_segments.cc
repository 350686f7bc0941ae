#include "identification/uncertainty/few_segments.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "identification/uncertainty/tails.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kFewestFree =
    8;  // segments beyond the parameters; why: tests/studies/identification.md, Few segments
constexpr double kNone = 1e-9;  // of a residual that the fit leaves free: counts as 0
constexpr double kMostFreedom = 1e4;
constexpr int kHalvings = 30;      // of the range of its logarithm
constexpr double kPrecise = 1e-7;  // of the integral for the coverage
constexpr unsigned kDepth = 12;

/// The rows of each segment among those of all kept samples.
std::vector<SampleRange> RowsOfSegments(const Selection& selection) {
  std::vector<SampleRange> all;
  Index sample = 0, row = 0;
  for (const Segment& segment : selection.segments) {
    // rows of the samples in front of the segment, then its own
    row += selection.keep.segment(sample, segment.begin - sample).count();
    const Index count = selection.keep.segment(segment.begin, segment.end - segment.begin).count();
    if (count > 0) all.push_back({row, count});
    row += count;
    sample = segment.end;
  }
  return all;
}

/// The share of a segment in the variance of the parameters.
struct Share {
  VectorXd score;  // [p] s_g
  MatrixXd own;    // [p x p] B^T B
  MatrixXd cross;  // [p x p] X_g^T B,  B = (I - X_g C X_g^T)^(-1/2) X_g C
};

/// X: [m x p] of the segment; r: [m].
Share ShareOf(const MatrixXd& X, const MatrixXd& cofactor, const VectorXd& r) {
  // X = Q R, so that I - X C X^T is I orthogonal to the columns of Q and I - R C R^T within their span
  const Index q = std::min(X.rows(), X.cols());
  const Eigen::HouseholderQR<MatrixXd> qr(X);
  const MatrixXd Q = qr.householderQ() * MatrixXd::Identity(X.rows(), q);
  const MatrixXd R = Q.transpose() * X;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> left(MatrixXd::Identity(q, q) -
                                                     R * cofactor * R.transpose());
  const VectorXd root =
      (left.eigenvalues().array() > kNone).select(left.eigenvalues().array().max(kNone).rsqrt(), 0);
  const MatrixXd adjust = left.eigenvectors() * root.asDiagonal() * left.eigenvectors().transpose();

  // the product needs only the part within the span of Q
  const MatrixXd B = adjust * R * cofactor;
  return {R.transpose() * adjust * (Q.transpose() * r), B.transpose() * B, R.transpose() * B};
}

/// P(N^2 <= q^2 e^T P e) for normal N and e, of independent entries of variance 1. It is computed from
/// the characteristic function of the weighted sum of chi^2 that e^T P e is (Imhof 1961). weights: eigenvalues of P.
double Coverage(double q, const VectorXd& weights) {
  const auto integrand = [&](double u) {
    double angle = 0.5 * std::atan(u), log_size = 0.25 * std::log1p(u * u);
    for (const double weight : weights) {
      const double w = q * q * weight * u;
      angle -= 0.5 * std::atan(w);
      log_size += 0.25 * std::log1p(w * w);
    }
    return std::sin(angle) / u * std::exp(-log_size);
  };
  using Rule = boost::math::quadrature::gauss_kronrod<double, 61>;
  const double integral =
      Rule::integrate(integrand, 0, std::numeric_limits<double>::infinity(), kDepth, kPrecise);
  return 0.5 - integral / std::numbers::pi;
}

/// The degrees of freedom with which Student's quantile times sqrt(e^T P e) covers 95 % of
/// the errors, whose variance is `variance` where that of e is 1. They are 1 at least.
double FreedomOf(const MatrixXd& P, double variance) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(P, Eigen::EigenvaluesOnly);
  const VectorXd weights = solver.eigenvalues().cwiseMax(0) / variance;
  // bisection, evenly in the logarithm
  double least = 0, most = std::log(kMostFreedom);
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (least + most);
    const double held = Coverage(StudentQuantile(std::exp(middle), kIntervalLevel), weights);
    (held < kIntervalLevel ? most : least) = middle;
  }
  return std::exp(least);
}

}  // namespace

bool HasFewSegments(const Selection& selection, Index p) {
  const auto segments = static_cast<Index>(RowsOfSegments(selection).size());
  return segments > 0 && segments < p + kFewestFree;
}

double FewestFreedom(const Selection& selection, Index p) {
  if (!HasFewSegments(selection, p)) return std::numeric_limits<double>::infinity();
  const auto segments = static_cast<double>(RowsOfSegments(selection).size());
  return std::max(segments - static_cast<double>(p), 1.0);
}

void CountSegments(const MatrixXd& X, const MatrixXd& cofactor, const VectorXd& residual,
                   const Selection& selection, Uncertainty& uncertainty) {
  uncertainty.by_samples = uncertainty.covariance;
  uncertainty.samples_degrees_of_freedom = uncertainty.degrees_of_freedom;
  // the scatter of the segments' scores takes the place of an assumed noise
  const Index p = cofactor.rows();
  MatrixXd scatter = MatrixXd::Zero(p, p);
  std::vector<Share> shares;
  for (const SampleRange& rows : RowsOfSegments(selection)) {
    shares.push_back(ShareOf(X.middleRows(rows.first, rows.count), cofactor,
                             residual.segment(rows.first, rows.count)));
    scatter += shares.back().score * shares.back().score.transpose();
  }

  // Of white noise the variance of parameter j is a sum of squares e^T P e, P over the segments with
  // P_gh = [g = h] b_g^T b_g - u_g^T C u_h, b_g column j of B and u_g that of X_g^T B.
  uncertainty.each_degrees_of_freedom.setOnes(p);
  uncertainty.degrees_of_freedom = 1;
  // no more segments than parameters do not show a scatter
  if (static_cast<Index>(shares.size()) <= p) return;
  const VectorXd before = uncertainty.covariance.diagonal();
  MatrixXd covariance = cofactor * scatter * cofactor;
  // variance and degrees of freedom of each parameter
  for (Index j = 0; j < p; ++j) {
    const auto count = static_cast<Index>(shares.size());
    MatrixXd P(count, count);
    for (Index g = 0; g < count; ++g) {
      const VectorXd pulled = cofactor * shares[static_cast<size_t>(g)].cross.col(j);
      for (Index h = 0; h < count; ++h) {
        P(g, h) = -pulled.dot(shares[static_cast<size_t>(h)].cross.col(j));
      }
      P(g, g) += shares[static_cast<size_t>(g)].own(j, j);
    }
    if (P.trace() > kNone * cofactor(j, j)) {
      uncertainty.each_degrees_of_freedom[j] = FreedomOf(P, cofactor(j, j));
      continue;
    }
    // where the segments show nothing of this parameter, its error stays
    const double scale = covariance(j, j) > 0 ? std::sqrt(before[j] / covariance(j, j)) : 0;
    covariance.row(j) *= scale;
    covariance.col(j) *= scale;
    covariance(j, j) = before[j];
  }
  uncertainty.covariance = covariance;
  uncertainty.degrees_of_freedom = uncertainty.each_degrees_of_freedom.minCoeff();
}

}  // namespace warmjoint
