// Estimates of the interface and of the rooms.
#pragma once

#include <warmjoint/estimate.h>

#include "identification/estimate.h"

namespace warmjoint::api {

/// Throws models::BadInput for a friction or a covariance that makes no sense.
identification::Estimate ToEstimate(const Estimate& estimate);

/// `recording` stays empty.
Estimate FromEstimate(const identification::Estimate& estimate);

Metrics FromMetrics(const identification::Metrics& metrics);

}  // namespace warmjoint::api
