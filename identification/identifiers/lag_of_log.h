// Whether a log's torque lags, for those who choose among structures.
#pragma once

#include <warmjoint/friction_model.h>

#include <optional>

#include "identification/holdout/predict_torque.h"
#include "identification/identifiers/structures.h"

namespace warmjoint::inline identification {

/// The lag, s, that a structure with the option torque_lag finds on every sample; nothing where the
/// log shows none to the model, the same structure's without lag. start: of that model.
std::optional<double> LagOf(const Structure& structure, const TorqueModel& without,
                            const CourseStart& start, const IdentifierInput& input);

/// The selection without the first five time constants of each run, after which 1/150 of what the lag
/// held is left, or without half of the run where it is shorter: what structures that know no lag may
/// see.
Selection Settled(const Measurements& measurements, Selection selection, double lag);

}  // namespace warmjoint::inline identification
