#include "identification/uncertainty/noise_model.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "identification/uncertainty/tails.h"

namespace warmjoint {
namespace {

constexpr Eigen::Index kLongestMemory =
    100'000;  // samples; why: an autocorrelation of 1 - 1e-4 has died away to 1e-4 by then
constexpr Eigen::Index kHighestOrder = 60;
// why: with 4 or 9 the intervals of 64 clean logs hold the truth as often
constexpr Eigen::Index kPatience = 6;  // orders without a better BIC

constexpr Eigen::Index kBlock = 256;  // samples that are filtered at once
constexpr double kDead = 1e-6;        // of the variance: covariances that count as 0
constexpr double kBeyondDoubt = 5;    // deviations of a normal variable
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Autocovariances of a sequence with gaps.
class Autocovariance {
 public:
  /// residual: [n] over the kept samples
  Autocovariance(const Eigen::VectorXd& residual, const Selection& selection)
      : size_(selection.keep.size()) {
    if (residual.size() == size_) {
      values_.resize(size_ + kAtOnce);
      values_ << residual, Eigen::VectorXd::Zero(kAtOnce);
      return;
    }
    values_ = Spread(residual, selection);
    kept_ = Spread(Eigen::VectorXd::Ones(residual.size()), selection);
  }

  /// Mean product of samples that are `lag` apart; 0 where too few pairs are.
  double At(Eigen::Index lag) {
    while (static_cast<Eigen::Index>(means_.size()) <= lag) AddMeans();
    return means_[static_cast<size_t>(lag)];
  }

 private:
  // why: as many columns as one product takes in registers; no result depends on it
  static constexpr Eigen::Index kAtOnce = 8;  // lags

  /// [N + kAtOnce] from [n]: 0 where not kept and beyond the end.
  static Eigen::VectorXd Spread(const Eigen::VectorXd& kept, const Selection& selection) {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(selection.keep.size() + kAtOnce);
    Eigen::Index row = 0;
    for (Eigen::Index i = 0; i < selection.keep.size(); ++i) {
      if (selection.keep[i]) all[i] = kept[row++];
    }
    return all;
  }

  /// Products of samples that are `first` and up to kAtOnce - 1 more apart. values: padded; [kAtOnce]
  Eigen::VectorXd Products(const Eigen::VectorXd& values, Eigen::Index first) const {
    // each column begins a sample later than the one before it
    const Eigen::Index n = std::max<Eigen::Index>(size_ - first, 0);
    const Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>> later(
        values.data() + std::min(first, size_), n, kAtOnce, Eigen::OuterStride<>(1));
    return later.transpose() * values.head(n);
  }

  void AddMeans() {
    const auto first = static_cast<Eigen::Index>(means_.size());
    const Eigen::VectorXd products = Products(values_, first);
    const Eigen::VectorXd pairs =
        kept_.size() > 0 ? Products(kept_, first)
                         : Eigen::VectorXd::Constant(kAtOnce, static_cast<double>(size_));
    for (Eigen::Index i = 0; i < kAtOnce; ++i) {
      means_.push_back(pairs[i] > 10 ? products[i] / pairs[i] : 0);
    }
  }

  Eigen::Index size_;            // N
  Eigen::VectorXd values_;       // padded
  Eigen::VectorXd kept_;         // 1 or 0, padded; empty where there is no gap
  std::vector<double> means_{};  // of the lags from 0 on
};

/// sum over all lags of the squared autocorrelation, from the model's own recursion.
double VarianceInflation(const NoiseModel& noise, const Eigen::VectorXd& covariances) {
  const Eigen::Index p = noise.order();
  const Eigen::VectorXd backwards = noise.coefficients.reverse();
  std::vector<double> r(covariances.begin(), covariances.begin() + p + 1);
  double sum = 1;
  for (Eigen::Index lag = 1; lag < kLongestMemory; ++lag) {
    // beyond its order the model continues its autocovariances
    if (lag > p) {
      const Eigen::Map<const Eigen::VectorXd> before(r.data() + lag - p, p);
      r.push_back(-backwards.dot(before));
    }
    const double correlation = r[lag] / noise.variance;
    sum += 2 * correlation * correlation;
    if (lag > p && std::abs(r[lag]) < 1e-4 * noise.variance) break;
  }
  return sum;
}

/// Row p + k of Z, k = 0 .. kBlock - 1: less the p rows before it, each times its coefficient. add(k, row) brings what
/// enters there. D: columns, where few are known, so that a row stays in registers; or Dynamic.
template <int D, typename Add>
void FilterBlock(const Eigen::RowVectorXd& coefficients, RowMajor& Z, Add&& add) {
  using Row = Eigen::Matrix<double, 1, D>;
  const Eigen::Index p = coefficients.size();
  for (Eigen::Index k = 0; k < kBlock; ++k) {
    if constexpr (D == Eigen::Dynamic) {
      Z.row(p + k).noalias() = -coefficients * Z.middleRows(k, p);
    } else {
      // two sums, so that neither waits for all p products
      Row even = Row::Zero(), odd = Row::Zero();
      const double* before = Z.data() + k * D;
      Eigen::Index j = 0;
      for (; j + 1 < p; j += 2, before += 2 * D) {
        even -= coefficients[j] * Eigen::Map<const Row>(before);
        odd -= coefficients[j + 1] * Eigen::Map<const Row>(before + D);
      }
      if (j < p) even -= coefficients[j] * Eigen::Map<const Row>(before);
      Z.row(p + k) = even + odd;
    }
    add(k, Z.row(p + k));
  }
}

/// The same for the columns that Z has.
template <typename Add>
void FilterBlockOfSize(const Eigen::RowVectorXd& coefficients, RowMajor& Z, Add&& add) {
  switch (Z.cols()) {
    case 1:
      return FilterBlock<1>(coefficients, Z, add);
    case 2:
      return FilterBlock<2>(coefficients, Z, add);
    case 3:
      return FilterBlock<3>(coefficients, Z, add);
    case 4:
      return FilterBlock<4>(coefficients, Z, add);
    case 5:
      return FilterBlock<5>(coefficients, Z, add);
    case 6:
      return FilterBlock<6>(coefficients, Z, add);
    default:
      return FilterBlock<Eigen::Dynamic>(coefficients, Z, add);
  }
}

}  // namespace

NoiseModel FitNoise(const Eigen::VectorXd& residual, const Selection& selection) {
  Autocovariance autocovariance(residual, selection);
  const auto n = static_cast<double>(residual.size());
  const Eigen::Index highest = std::min(kHighestOrder, residual.size() / 10);

  NoiseModel best;
  best.variance = best.innovation = residual.squaredNorm() / n;
  if (best.variance <= 0 || highest < 1) return best;

  // Levinson: order by order, each from the one before
  Eigen::VectorXd covariances = Eigen::VectorXd::Zero(highest + 1);
  covariances[0] = best.variance;
  Eigen::VectorXd a(highest), next(highest);  // as many of them as the order
  double innovation = best.variance;
  double best_bic = n * std::log(innovation);
  for (Eigen::Index p = 1; p <= highest && p <= best.order() + kPatience; ++p) {
    covariances[p] = autocovariance.At(p);
    // what the model so far leaves of this lag is the next reflection coefficient
    const auto known = a.head(p - 1);
    const double past = known.dot(covariances.segment(1, p - 1).reverse());
    const double reflection = -(covariances[p] + past) / innovation;
    if (!(std::abs(reflection) < 1)) break;
    next.head(p - 1) = known + reflection * known.reverse();
    next[p - 1] = reflection;
    a.swap(next);
    innovation *= 1 - reflection * reflection;

    // the order with the smallest Bayesian information criterion
    const double bic = n * std::log(innovation) + static_cast<double>(p) * std::log(n);
    if (bic >= best_bic) continue;
    best_bic = bic;
    best.coefficients = a.head(p);
    best.covariances = covariances.head(p + 1);
    best.innovation = innovation;
  }
  // the figures that users of the model need
  best.correlation = covariances[1] / best.variance;
  best.variance_inflation = best.order() > 0 ? VarianceInflation(best, covariances) : 1;
  return best;
}

Eigen::VectorXd CovariancesOf(const NoiseModel& noise, Eigen::Index last) {
  const Eigen::Index p = noise.order();
  const Eigen::VectorXd backwards = noise.coefficients.reverse();
  Eigen::VectorXd r = Eigen::VectorXd::Zero(std::max(last, p) + 1);
  r[0] = noise.variance;
  if (p > 0) r.head(p + 1) = noise.covariances;
  Eigen::Index small = 0;  // in a row
  // on by the recursion, until p lags in a row are dead
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

Eigen::MatrixXd ScatterThrough(const NoiseModel& noise, const RowsBetween& rows, Eigen::Index d,
                               const Selection& selection) {
  // R = innovation M^-1 M^-T with M e = w, so that A^T R A = innovation Z^T Z, M^T Z = A;
  // Z is filled backwards in time, a block of rows after the last p of the block before it
  const Eigen::Index p = noise.order();
  const Eigen::RowVectorXd coefficients = noise.coefficients.reverse();
  RowMajor Z = RowMajor::Zero(p + kBlock, d);
  Eigen::MatrixXd scatter = Eigen::MatrixXd::Zero(d, d);
  Eigen::RowVectorXd largest = Eigen::RowVectorXd::Zero(d);
  Eigen::Index row = selection.count();
  for (Eigen::Index end = selection.keep.size(); end > -kLongestMemory; end -= kBlock) {
    // rows of a block of samples; those between kept ones are 0
    const Eigen::Index begin = std::max<Eigen::Index>(end - kBlock, 0);
    const Eigen::Index kept = end > 0 ? selection.keep.segment(begin, end - begin).count() : 0;
    const Eigen::MatrixXd input = kept > 0 ? rows(row - kept, row) : Eigen::MatrixXd(0, d);
    Eigen::Index next = kept;
    // recursion of the transposed filter, one sample back at a time
    FilterBlockOfSize(coefficients, Z, [&](Eigen::Index k, auto out) {
      const Eigen::Index i = end - 1 - k;
      if (i >= 0 && selection.keep[i]) out += input.row(--next);
    });
    row -= kept;
    scatter.selfadjointView<Eigen::Lower>().rankUpdate(Z.bottomRows(kBlock).transpose());

    // before the first sample: until it has died away, which white noise has at once
    if (end <= kBlock && p == 0) break;
    Z.topRows(p) = Z.bottomRows(p).eval();
    largest = largest.cwiseMax(Z.cwiseAbs().colwise().maxCoeff());
    if (end > kBlock) continue;
    const Eigen::RowVectorXd left = Z.topRows(p).cwiseAbs().colwise().maxCoeff();
    if (((left - 1e-4 * largest).array() <= 0).all()) break;
  }
  scatter.triangularView<Eigen::StrictlyUpper>() = scatter.transpose();
  return noise.innovation * scatter;
}

}  // namespace warmjoint
