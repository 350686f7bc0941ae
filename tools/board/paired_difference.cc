#include "tools/board/paired_difference.h"

#include <algorithm>
#include <limits>

#include "models/foundation/random_stream.h"
#include "tools/board/statistics.h"

namespace warmjoint::inline tools {
namespace {

constexpr int kResamples = 1000;
constexpr auto kBootstrap = static_cast<Stream>(16);  // apart from those of realizations

/// Middle of the values, the lower one of two; reorders them.
double Middle(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<long>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

Difference PairedDifference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> differences;
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    differences.push_back(a[i] == b[i] ? 0 : a[i] - b[i]);
  }
  if (differences.empty()) {
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    return {unknown, unknown, unknown};
  }

  RandomStream random({0, 0}, kBootstrap);
  std::vector<double> medians, sample(differences.size());
  for (int i = 0; i < kResamples; ++i) {
    for (double& value : sample) value = differences[random.Below(differences.size())];
    medians.push_back(Middle(sample));
  }
  std::sort(medians.begin(), medians.end());
  std::sort(differences.begin(), differences.end());
  return {Quantile(differences, 0.5), Quantile(medians, 0.025), Quantile(medians, 0.975)};
}

}  // namespace warmjoint::inline tools
