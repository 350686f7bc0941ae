// Figures of a fit on samples that it has not seen.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/friction_model.h>

#include <optional>

#include "identification/fit.h"
#include "identification/holdout/predict_torque.h"

namespace warmjoint {

/// What the fit knows of the torque, its lag on the way into the log too.
TorqueModel ModelOf(const Fit& fit);

/// Compares the torque that the fit's friction, gravity and inertia predict along a log with the samples that
/// `test` keeps; where the fit knows its gravity only in places, with those there. The prediction
/// runs from the first sample on, from `start`. Nothing where the fit gives no
/// friction or no sample is left.
std::optional<Metrics> Evaluate(const Fit& fit, const Measurements& measurements, Selection test,
                                const CourseStart& start);

}  // namespace warmjoint
