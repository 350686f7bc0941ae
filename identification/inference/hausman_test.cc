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

void AddStructure(const Disagreement& structure, const Eigen::VectorXd& friction, Fit& fit) {
  // columns of gravity may have no name of their own
  const auto row = static_cast<std::size_t>(structure.parameter);
  const bool named = row < fit.parameters.size() && !fit.parameters[row].name.empty();
  const std::string name = named ? fit.parameters[row].name : "gravity";

  // how far the structure moves the fitted torque, beside the size of the friction
  const double moved = Rms(Kept(fit.jacobian(), fit.used) * structure.differences);
  if (!(moved < kDefaultRelevance * Rms(friction))) {
    fit.causes.push_back(DropsIntervals(DescribeDisagreement(structure, name)));
    return;
  }
  fit.errors.structure = structure.differences;
  fit.causes.push_back(Remark(
      fmt::format("the residual is not only noise: treating its slow part as noise would "
                  "change {} by {:.2g} standard errors; intervals were widened to cover this",
                  name, structure.deviations)));
}

}  // namespace warmjoint
