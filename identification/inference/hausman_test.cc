#include "identification/inference/hausman_test.h"

#include <fmt/format.h>
#include <warmjoint/estimate.h>

#include <cmath>

#include "identification/fit_data.h"

namespace warmjoint {
namespace {

double Rms(const Eigen::VectorXd& values) {
  return values.norm() / std::sqrt(static_cast<double>(values.size()));
}

}  // namespace

void ApplyHausmanTest(const Fit& fit, Inference& inference) {
  // columns of gravity may have no name of their own
  const auto& [structure, friction] = *fit.unmodelled_residual;
  const auto row = static_cast<std::size_t>(structure.parameter);
  const bool named = row < fit.parameters.size() && !fit.parameters[row].name.empty();
  const std::string name = named ? fit.parameters[row].name : "gravity";

  // how far the structure moves the fitted torque, beside the size of the friction
  const double moved = Rms(Kept(fit.jacobian(), fit.used) * structure.differences);
  if (!(moved < kDefaultRelevance * Rms(friction))) {
    inference.without_intervals = DescribeDisagreement(structure, name);
    return;
  }

  // little beside the friction: it joins the errors as one more of them
  inference.known.covariance += structure.differences * structure.differences.transpose();
  inference.warnings.push_back(
      fmt::format("the residual is not only noise: treating its slow part as noise would change {} "
                  "by {:.2g} standard errors; intervals were widened to cover this",
                  name, structure.deviations));
}

}  // namespace warmjoint
