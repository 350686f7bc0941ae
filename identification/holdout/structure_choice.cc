#include "identification/holdout/structure_choice.h"

#include <cmath>

namespace warmjoint {
namespace {

/// Standard error of the mean of independent values. [n], n >= 2
double StandardError(const Eigen::VectorXd& values) {
  const auto n = static_cast<double>(values.size());
  const double variance = (values.array() - values.mean()).square().sum() / (n - 1);
  return std::sqrt(variance / n);
}

}  // namespace

double Bic(double mean_square, double parameters, double samples) {
  return samples * std::log(mean_square) + parameters * std::log(samples);
}

Choice ChooseStructure(const std::vector<StructureCandidate>& contenders, double samples) {
  Choice choice;
  // the one of the least error on blocks that it has not seen
  for (size_t i = 1; i < contenders.size(); ++i) {
    if (contenders[i].errors.mean() < contenders[choice.best].errors.mean()) choice.best = i;
  }

  // of all that are not worse beyond doubt, the simplest
  const StructureCandidate& best = contenders[choice.best];
  const auto bic = [&](const StructureCandidate& one) {
    return Bic(one.in_sample, one.parameters, samples);
  };
  choice.chosen = choice.best;
  for (size_t i = 0; i < contenders.size(); ++i) {
    const StructureCandidate& one = contenders[i];
    const Eigen::VectorXd difference = one.errors - best.errors;
    const double doubt = StandardError(difference);
    // as good as the best within one standard error, or by BIC
    const bool equal = difference.mean() <= doubt || bic(one) <= bic(best);
    const StructureCandidate& so_far = contenders[choice.chosen];
    // with fewer parameters, or with as many and a smaller error
    const bool simpler =
        one.parameters < so_far.parameters ||
        (one.parameters == so_far.parameters && one.errors.mean() < so_far.errors.mean());
    if (!equal || !simpler) continue;
    choice.chosen = i;
    choice.excess = difference.mean();
    choice.doubt = doubt;
  }
  return choice;
}

}  // namespace warmjoint
