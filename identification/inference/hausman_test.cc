#include "identification/inference/hausman_test.h"

#include <warmjoint/estimate.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string>
#include <vector>

#include "identification/fit/fit_data.h"
#include "identification/inference/inference.h"
#include "identification/sentences/fit.h"
#include "identification/uncertainty/tails.h"

namespace warmjoint {

namespace {

constexpr double kBeyondDoubt = 5;   // deviations of a normal variable
constexpr double kLeastShare = 0.1;  // of the plain fit's variance

double Rms(const Eigen::VectorXd& values) {
  return values.norm() / std::sqrt(static_cast<double>(values.size()));
}

}  // namespace

std::optional<Disagreement> FindDisagreement(const FitOfRows& plain, const FitOfRows& whitened,
                                             double degrees_of_freedom) {
  Disagreement most;
  for (Eigen::Index j = 0; j < plain.x.size(); ++j) {
    // the difference from an efficient fit has the difference of both variances (Hausman)
    const double before = plain.covariance(j, j);
    const double variance = std::max(before - whitened.covariance(j, j), kLeastShare * before);
    const double difference = whitened.x[j] - plain.x[j];
    const double deviations = std::abs(difference) / std::sqrt(variance);
    if (deviations > most.deviations) most = {j, deviations, {}};
  }
  if (!(most.deviations > 0)) return std::nullopt;
  // of the largest of p differences (Bonferroni)
  const double p =
      static_cast<double>(plain.x.size()) * PValueOfStudent(most.deviations, degrees_of_freedom);
  if (p >= PValueOfNormal(kBeyondDoubt)) return std::nullopt;
  most.differences = whitened.x - plain.x;
  return most;
}

Cause StructureCause(const Disagreement& structure, const Eigen::VectorXd& friction,
                     const Fit& fit) {
  // columns of gravity may have no name of their own
  const auto row = static_cast<std::size_t>(structure.parameter);
  const bool named = row < fit.parameters.size() && !fit.parameters[row].name.empty();
  const std::string name = named ? fit.parameters[row].name : "gravity";

  // how much the structure changes the fitted torque, relative to the friction
  const double moved = Rms(Kept(fit.rows.jacobian(), fit.rows.used) * structure.differences);
  if (!(moved < kDefaultRelevance * Rms(friction))) {
    return DropsIntervals(ExplainStructure(name, structure.deviations, Action::drop_intervals));
  }

  // d is known no better than the noise, so the quantile is that of the noise's degrees of freedom
  const double reach =
      StudentQuantile(CovarianceOf(fit).degrees_of_freedom, kIntervalLevel) / kNormal95;

  // d in the values of the table
  Cause cause{.source = Source::structure,
              .action = Action::widen,
              .sentence = ExplainStructure(name, structure.deviations, Action::widen)};
  for (std::size_t i = 0; i < fit.parameters.size(); ++i) {
    const Unknown& one = fit.parameters[i];
    if (!one.estimated) continue;
    cause.Add(i,
              reach * one.ValueByCoordinate(one.value) * structure.differences[cause.bias.size()]);
  }
  cause.spread = cause.bias;
  cause.bias.setZero();
  return cause;
}

}  // namespace warmjoint
