// Estimates of the interface and of the rooms.
#pragma once

#include <warmjoint/estimate.h>

#include "identification/estimate.h"
#include "tools/actions/carried_heat.h"

namespace warmjoint::api {

/// Throws models::BadInput for a friction or a covariance that makes no sense.
identification::Estimate ToEstimate(const Estimate& estimate);

/// `recording` and `follows` stay empty.
Estimate FromEstimate(const identification::Estimate& estimate);

tools::CarriedHeat ToCarried(const CarriedHeat& carried);
CarriedHeat FromCarried(const tools::CarriedHeat& carried);

Metrics FromMetrics(const identification::Metrics& metrics);

}  // namespace warmjoint::api
