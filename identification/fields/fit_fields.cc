#include "identification/fields/fit_fields.h"

#include <optional>
#include <string>
#include <utility>

#include "identification/fields/field_rows.h"
#include "identification/fields/fields_about.h"
#include "identification/fit/fit_along.h"
#include "identification/fit/seen_samples.h"
#include "identification/forward/log_trajectory.h"
#include "identification/sentences/fields.h"
#include "identification/warming/initial_energy.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Why a fit has no fields, where it could not have any; empty where nothing is left for them.
std::optional<std::string> WhyNone(const Fit& fit) {
  if (!fit.model.friction.maps.empty()) return kNoFieldsBesideMaps;
  if (fit.model.lag || fit.rows.loss_bend) return kNoFieldsBesideLag;
  if (IsRounding(fit.rows.residual().squaredNorm(), fit.rows.torque)) return "";
  if (!fit.rows.jacobian || fit.rows.errors.covariance) return kNoFieldsBesideCovariance;
  return std::nullopt;
}

/// What a fit knew beforehand: its prior has the noise's variance over that of each unknown, about 0 but for E(0).
void TakePrior(double start, FitForFields& at) {
  const Fit& fit = at.fit;
  const Eigen::MatrixXd& prior = fit.rows.errors.prior;
  if (prior.size() == 0) return;
  const double variance =
      fit.rows.residual().squaredNorm() / static_cast<double>(fit.rows.torque.size());
  at.prior_precision = prior / variance;
  at.prior_mean = VectorXd::Zero(prior.rows());
  Index column = 0;
  for (const Unknown& row : fit.parameters) {
    if (!row.estimated) continue;
    if (row.role == Role::start) at.prior_mean[column] = start;
    ++column;
  }
}

/// A fit as fields are fitted about it.
FitForFields ForFields(Fit fit, const IdentifierInput& input) {
  auto followed = Followed(input.measurements, fit.rows.used, PartsOf(fit));
  FitForFields at{.fit = std::move(fit),
                  .motion = followed ? std::move(followed->measurements) : input.measurements};
  TakePrior(InitialEnergyOf(input.options).mean, at);
  at.torque_of = TorqueAlong;
  return at;
}

}  // namespace

Fit FitWithFields(const IdentifierInput& input,
                  const std::function<Fit(const IdentifierInput&)>& make) {
  const auto* option = input.options.Find<FieldOption>();
  Fit fit = make(input);
  if (fit.refusal || !option || option->fields.kinds.empty()) return fit;
  if (auto why = WhyNone(fit)) {
    if (!why->empty()) fit.causes.push_back(Note(*why));
    return fit;
  }
  const auto again = [&](const VectorXd& held) -> std::optional<FitForFields> {
    LogView less{input.measurements, input.selection};
    less.measurements.torque -= held;
    Fit next = make(input.On(less));
    if (next.refusal || WhyNone(next)) return std::nullopt;
    return ForFields(std::move(next), input);
  };
  return WithFieldsAbout(ForFields(std::move(fit), input), option->fields, again);
}

}  // namespace warmjoint
