// Fields about a fit of any kind: rounds of both, and the answer.
#pragma once

#include <warmjoint/fields.h>
#include <warmjoint/prepared_log.h>

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "identification/fit/fit.h"

namespace warmjoint {

/// A fit with all that fields need of it. Its Jacobian is that of its table's estimated rows.
struct FitForFields {
  Fit fit{};
  LogSamples motion{};  // [N] that its torque follows, with the measured torque
  /// [N] torque of a fit of this table along a motion, N.m or N: gravity, inertia and friction, maps included
  std::function<Eigen::VectorXd(const Fit&, const LogSamples&)> torque_of{};
  /// [p] of what is known of the estimated rows beforehand, and its precision, 0 where nothing is; or empty
  Eigen::VectorXd prior_mean{};
  Eigen::MatrixXd prior_precision{};  // [p x p]
};

/// The same fit to what fields leave of the torque; nothing where that has no such fit. held: [N] N.m or N
using FitToTheRest = std::function<std::optional<FitForFields>(const Eigen::VectorXd& held)>;

/// The fit with the fields that are asked for (FitWithFields). again: of a fit that is not linear in its unknowns
Fit WithFieldsAbout(FitForFields first, const FieldSet& asked, const FitToTheRest& again);

}  // namespace warmjoint
