// What an estimate says of the heat that its recording began with.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/friction_model.h>
#include <warmjoint/prepared_log.h>

namespace warmjoint {

/// E(0) of each recording and the jumps of E at gaps (gaps.h), as far as the estimate has them. What is
/// not estimated is 0.
/// measurements: those that the estimate was fitted to.
ThermalStart StartOf(const Estimate& estimate, const LogSamples& measurements);

}  // namespace warmjoint
