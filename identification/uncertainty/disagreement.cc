#include "identification/uncertainty/disagreement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "identification/uncertainty/tails.h"

namespace warmjoint {
namespace {

constexpr double kBeyondDoubt = 5;   // deviations of a normal variable
constexpr double kLeastShare = 0.1;  // of the plain fit's variance

}  // namespace

std::optional<Disagreement> FindDisagreement(const FitOfRows& plain, const FitOfRows& whitened,
                                             double freedom) {
  Disagreement most;
  for (Eigen::Index j = 0; j < plain.x.size(); ++j) {
    // the difference from an efficient fit has the difference of both variances (Hausman)
    const double before = plain.covariance(j, j);
    const double variance = std::max(before - whitened.covariance(j, j), kLeastShare * before);
    const double difference = whitened.x[j] - plain.x[j];
    const double deviations = std::abs(difference) / std::sqrt(variance);
    if (deviations > most.deviations) most = {j, difference, deviations, {}};
  }
  if (!(most.deviations > 0)) return std::nullopt;
  // of the largest of p differences (Bonferroni)
  const double p = static_cast<double>(plain.x.size()) * PValueOfStudent(most.deviations, freedom);
  if (p >= PValueOfNormal(kBeyondDoubt)) return std::nullopt;
  most.differences = whitened.x - plain.x;
  return most;
}

std::string DescribeDisagreement(const Disagreement& found, const std::string& name) {
  return fmt::format(
      "no intervals are given, since the residual holds structure and not only noise: treating its "
      "slow part as noise would change {} by {:.2g} standard errors",
      name, found.deviations);
}

}  // namespace warmjoint
