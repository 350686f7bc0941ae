#include "identification/uncertainty/noise_model.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "identification/uncertainty/tails.h"

namespace warmjoint::inline identification {
namespace {

constexpr Eigen::Index kHighestOrder = 60;
// why: with 4 or 9 the intervals of 64 clean logs hold the truth as often
constexpr Eigen::Index kPatience = 6;  // orders without a better BIC

constexpr Eigen::Index kBlock = 256;  // samples that are filtered at once
constexpr double kDead = 1e-6;        // of the variance: covariances that are as good as 0
constexpr double kBeyondDoubt = 5;    // deviations of a normal variable
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Autocovariances of a sequence with gaps. values: [N], 0 where not kept; kept: [N] 1 or 0.
class Autocovariance {
 public:
  Autocovariance(const Eigen::VectorXd& values, const Selection& selection)
      : values_(values), kept_(selection.keep.cast<double>()), gaps_(!selection.keep.all()) {}

  /// Mean product of samples that are `lag` apart; 0 where too few pairs are.
  double At(Eigen::Index lag) const {
    const Eigen::Index n = values_.size() - lag;
    const double pairs =
        gaps_ ? kept_.head(n).dot(kept_.tail(n)) : static_cast<double>(values_.size());
    const double products = values_.head(n).dot(values_.tail(n));
    return pairs > 10 ? products / pairs : 0;
  }

 private:
  const Eigen::VectorXd& values_;
  Eigen::VectorXd kept_;
  bool gaps_;
};

/// [N] from [n]: 0 where not kept.
Eigen::VectorXd Spread(const Eigen::VectorXd& kept, const Selection& selection) {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(selection.keep.size());
  Eigen::Index row = 0;
  for (Eigen::Index i = 0; i < all.size(); ++i) {
    if (selection.keep[i]) all[i] = kept[row++];
  }
  return all;
}

/// sum over all lags of the squared autocorrelation, from the model's own recursion.
double Redundancy(const NoiseModel& noise, const Eigen::VectorXd& covariances) {
  const Eigen::Index p = noise.order();
  std::vector<double> r(covariances.begin(), covariances.begin() + p + 1);
  double sum = 1;
  for (Eigen::Index lag = 1; lag < 100000; ++lag) {
    if (lag > p) {
      double next = 0;
      for (Eigen::Index k = 0; k < p; ++k) next -= noise.coefficients[k] * r[lag - 1 - k];
      r.push_back(next);
    }
    sum += 2 * std::pow(r[lag] / noise.variance, 2);
    if (lag > p && std::abs(r[lag]) < 1e-4 * noise.variance) break;
  }
  return sum;
}

}  // namespace

NoiseModel FitNoise(const Eigen::VectorXd& residual, const Selection& selection) {
  const Eigen::VectorXd values = Spread(residual, selection);
  const Autocovariance autocovariance(values, selection);
  const auto n = static_cast<double>(residual.size());
  const Eigen::Index highest = std::min(kHighestOrder, residual.size() / 10);

  NoiseModel best;
  best.variance = best.innovation = residual.squaredNorm() / n;
  if (best.variance <= 0 || highest < 1) return best;

  // Levinson: order by order, each from the one before
  Eigen::VectorXd covariances = Eigen::VectorXd::Zero(highest + 1);
  covariances[0] = best.variance;
  Eigen::VectorXd a;
  double innovation = best.variance;
  double best_bic = n * std::log(innovation);
  for (Eigen::Index p = 1; p <= highest && p <= best.order() + kPatience; ++p) {
    covariances[p] = autocovariance.At(p);
    const double past = a.dot(covariances.segment(1, p - 1).reverse());
    const double reflection = -(covariances[p] + past) / innovation;
    if (!(std::abs(reflection) < 1)) break;
    Eigen::VectorXd next(p);
    next << a + reflection * a.reverse(), reflection;
    a = next;
    innovation *= 1 - reflection * reflection;

    const double bic = n * std::log(innovation) + static_cast<double>(p) * std::log(n);
    if (bic >= best_bic) continue;
    best_bic = bic;
    best.coefficients = a;
    best.covariances = covariances.head(p + 1);
    best.innovation = innovation;
  }
  best.correlation = covariances[1] / best.variance;
  best.redundancy = best.order() > 0 ? Redundancy(best, covariances) : 1;
  return best;
}

Eigen::VectorXd CovariancesOf(const NoiseModel& noise, Eigen::Index last) {
  const Eigen::Index p = noise.order();
  const Eigen::VectorXd backwards = noise.coefficients.reverse();
  Eigen::VectorXd r = Eigen::VectorXd::Zero(std::max(last, p) + 1);
  r[0] = noise.variance;
  if (p > 0) r.head(p + 1) = noise.covariances;
  Eigen::Index small = 0;  // in a row
  for (Eigen::Index lag = p + 1; p > 0 && lag <= last && small < p; ++lag) {
    r[lag] = -backwards.dot(r.segment(lag - p, p));
    small = std::abs(r[lag]) < kDead * noise.variance ? small + 1 : 0;
  }
  return r.head(last + 1);
}

bool IsSurelyColoured(const NoiseModel& noise, Eigen::Index n) {
  if (noise.order() == 0 || !(noise.innovation > 0)) return false;
  const auto p = static_cast<double>(noise.order()), samples = static_cast<double>(n);
  const double ratio = samples * std::log(noise.variance / noise.innovation);
  return static_cast<double>(kHighestOrder) * PValueOfF(ratio / p, p, samples) <
         PValueOfNormal(kBeyondDoubt);
}

Eigen::MatrixXd ScatterThrough(const NoiseModel& noise, const Eigen::MatrixXd& A,
                               const Selection& selection) {
  if (noise.order() == 0) return noise.variance * (A.transpose() * A);
  const auto rows = [&](Eigen::Index first, Eigen::Index last) -> Eigen::MatrixXd {
    return A.middleRows(first, last - first);
  };
  return ScatterThrough(noise, rows, A.cols(), selection);
}

Eigen::MatrixXd ScatterThrough(
    const NoiseModel& noise,
    const std::function<Eigen::MatrixXd(Eigen::Index first, Eigen::Index last)>& rows,
    Eigen::Index d, const Selection& selection) {
  // R = innovation M^-1 M^-T with M e = w, so that A^T R A = innovation Z^T Z, M^T Z = A;
  // Z is filled backwards in time, a block of rows after the last p of the block before it
  const Eigen::Index p = noise.order();
  const Eigen::RowVectorXd coefficients = noise.coefficients.reverse();
  RowMajor Z = RowMajor::Zero(p + kBlock, d);
  Eigen::MatrixXd scatter = Eigen::MatrixXd::Zero(d, d);
  Eigen::RowVectorXd largest = Eigen::RowVectorXd::Zero(d);
  Eigen::Index row = selection.count();
  for (Eigen::Index end = selection.keep.size(); end > -100000; end -= kBlock) {
    const Eigen::Index begin = std::max<Eigen::Index>(end - kBlock, 0);
    const Eigen::Index kept = end > 0 ? selection.keep.segment(begin, end - begin).count() : 0;
    const Eigen::MatrixXd input = kept > 0 ? rows(row - kept, row) : Eigen::MatrixXd(0, d);
    Eigen::Index next = kept;
    for (Eigen::Index k = 0; k < kBlock; ++k) {
      const Eigen::Index i = end - 1 - k;
      Z.row(p + k).noalias() = -coefficients * Z.middleRows(k, p);
      if (i >= 0 && selection.keep[i]) Z.row(p + k) += input.row(--next);
    }
    row -= kept;
    scatter.selfadjointView<Eigen::Lower>().rankUpdate(Z.bottomRows(kBlock).transpose());

    // before the first sample: until it has died away
    Z.topRows(p) = Z.bottomRows(p).eval();
    largest = largest.cwiseMax(Z.cwiseAbs().colwise().maxCoeff());
    const Eigen::RowVectorXd left = Z.topRows(p).cwiseAbs().colwise().maxCoeff();
    if (end - kBlock <= 0 && ((left - 1e-4 * largest).array() <= 0).all()) break;
  }
  scatter.triangularView<Eigen::StrictlyUpper>() = scatter.transpose();
  return noise.innovation * scatter;
}

}  // namespace warmjoint::inline identification
