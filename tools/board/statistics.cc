#include "tools/board/statistics.h"

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>
#include <iterator>

#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

/// The numbers in ascending order, NaN left out.
void KeepSorted(std::vector<double>& values) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  std::sort(values.begin(), values.end());
}

/// The k from 1 to n for which the median of a resample of n is at most the k-th smallest with
/// probability `level` or more for the first time.
std::size_t BootstrapRank(std::size_t n, double level) {
  const auto middle = static_cast<double>((n + 1) / 2), count = static_cast<double>(n);
  const auto reaches = [&](std::size_t k) {
    return boost::math::ibeta(middle, count - middle + 1, static_cast<double>(k) / count) >= level;
  };
  // the probability grows with k and is 1 at n
  std::size_t below = 0, reached = n;
  while (reached - below > 1) {
    const std::size_t k = below + (reached - below) / 2;
    (reaches(k) ? reached : below) = k;
  }
  return reached;
}

}  // namespace

double RootMeanSquareOf(const std::vector<double>& values) {
  double sum = 0;
  std::size_t count = 0;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    sum += value * value;
    ++count;
  }
  return std::sqrt(sum / static_cast<double>(count));
}

Summary Summarise(std::vector<double> values) {
  const double rms = RootMeanSquareOf(values);
  KeepSorted(values);
  return {{Quantile(values, 0.5), Quantile(values, 0.25), Quantile(values, 0.75)}, rms};
}

std::vector<double> SortedFinite(const Eigen::VectorXd& values) {
  std::vector<double> sorted;
  std::copy_if(values.begin(), values.end(), std::back_inserter(sorted),
               [](double value) { return std::isfinite(value); });
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

double MedianOfKnown(const Eigen::VectorXd& values) {
  return Summarise({values.begin(), values.end()}).median;
}

QuartileCurve QuartilesOf(const Eigen::VectorXd& x, const Eigen::MatrixXd& values) {
  const Eigen::Index columns = values.cols();
  QuartileCurve curve{x, Eigen::VectorXd(columns), Eigen::VectorXd(columns),
                      Eigen::VectorXd(columns)};
  for (Eigen::Index k = 0; k < columns; ++k) {
    const auto column = values.col(k);
    const Summary summary = Summarise({column.begin(), column.end()});
    curve.q25[k] = summary.q25;
    curve.median[k] = summary.median;
    curve.q75[k] = summary.q75;
  }
  return curve;
}

Difference MedianDifference(std::vector<double> differences) {
  KeepSorted(differences);
  const double median = Quantile(differences, 0.5);
  if (differences.empty()) return {median, median, median};
  // ends of the interval as a bootstrap of the median has them
  const auto end = [&](double level) {
    return differences[BootstrapRank(differences.size(), level) - 1];
  };
  return {median, end(0.025), end(0.975)};
}

}  // namespace warmjoint
