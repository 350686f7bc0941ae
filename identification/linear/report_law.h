// The parameters of the nominal law in an estimate.
#pragma once

#include <Eigen/Core>

#include "identification/estimate.h"
#include "identification/uncertainty/uncertainty.h"
#include "models/friction/law.h"
#include "models/recording/measurements.h"

namespace warmjoint::inline identification {

/// Appends the law's parameters. values: [d], in the order of its table; known: its first d rows
/// are theirs.
void ReportLaw(const Law& law, const Eigen::VectorXd& values, const Uncertainty& known,
               const Measurements& measurements, Estimate& estimate);

}  // namespace warmjoint::inline identification
