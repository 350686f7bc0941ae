// Dependence of a residual on position and energy together: maps that fade as the joint warms.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "identification/adequacy/fitted_model.h"
#include "identification/adequacy/structure.h"

namespace warmjoint::inline identification {

/// Tests whether the part of the fit that its maps give, m(x), fades or grows with the heat: m E,
/// beside law, warming and m (growing_fit.h), sample by sample.
/// residual: [N] tau - F, smooth structure taken off; what is found is taken off it. Nothing where
/// the fit has no maps or knows no warming.
std::optional<Structure> FindFading(const FittedModel& model, Eigen::VectorXd& residual);

}  // namespace warmjoint::inline identification
