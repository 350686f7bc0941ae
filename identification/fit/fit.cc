#include "identification/fit/fit.h"

#include <utility>

#include "identification/fit/fit_data.h"
#include "identification/model/normal_equations.h"

namespace warmjoint {

std::vector<double> Fit::Values(Role role) const {
  std::vector<double> values;
  for (const Unknown& parameter : parameters) {
    if (parameter.role == role) values.push_back(parameter.value);
  }
  return values;
}

ThermalStart Fit::Start() const {
  ThermalStart begin;
  begin.energy = start.energy;
  // each jump at the sample where it happens
  const std::vector<double> jumps = Values(Role::jump);
  for (size_t i = 0; i < start.jump_samples.size(); ++i) {
    begin.jumps.push_back({start.jump_samples[i], jumps[i]});
  }
  return begin;
}

std::optional<size_t> Fit::RowOf(Role role, int which) const {
  for (size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].role == role && which-- == 0) return i;
  }
  return std::nullopt;
}

void ErrorModel::AddFree() {
  const Eigen::Index p = prior.rows();
  if (p > 0) prior.conservativeResizeLike(Eigen::MatrixXd::Zero(p + 1, p + 1));
}

Eigen::MatrixXd CofactorOf(const Fit& fit) {
  const ErrorModel& errors = fit.rows.errors;
  Eigen::MatrixXd rows = Kept(fit.rows.jacobian(), fit.rows.used);
  if (errors.whitening) rows = errors.whitening->Of(rows);
  Eigen::MatrixXd normal = GramOf(rows);
  if (errors.prior.size() > 0) normal += errors.prior;
  return Cofactor(normal);
}

Fit Refused(std::string identifier, Refusal refusal) {
  Fit fit;
  fit.identifier = std::move(identifier);
  fit.refusal = std::move(refusal);
  return fit;
}

Fit Refused(std::string identifier, Status status, std::string message) {
  return Refused(std::move(identifier), {status, std::move(message)});
}

}  // namespace warmjoint
