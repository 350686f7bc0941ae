#include "tools/board/paired_difference.h"

#include <boost/math/special_functions/beta.hpp>
#include <limits>

#include "tools/board/statistics.h"

namespace warmjoint::inline tools {
namespace {

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

Difference PairedDifference(const NumberColumn& a, const NumberColumn& b) {
  // differences on the same realization; two that fail alike do not differ
  NumberColumn differences;
  ForEachPair(a, b, [&](double x, double y) { differences.Add(x == y ? 0 : x - y); });
  const Ascending ascending(differences);
  if (ascending.size() == 0) {
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    return {unknown, unknown, unknown};
  }
  // ends of the interval as a bootstrap of the median has them
  const auto end = [&](double level) {
    return ascending[BootstrapRank(ascending.size(), level) - 1];
  };
  return {ascending.Quantile(0.5), end(0.025), end(0.975)};
}

}  // namespace warmjoint::inline tools
