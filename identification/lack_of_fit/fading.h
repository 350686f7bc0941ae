// Maps that fade or grow as a joint warms.
#pragma once

#include <Eigen/Core>

#include "identification/lack_of_fit/error_level.h"
#include "identification/lack_of_fit/fitted_model.h"
#include "identification/lack_of_fit/table.h"

namespace warmjoint {

/// Whether what the maps give goes with the energy, beside maps whose strength is free.
/// residual: [N] tau - F; what is found is taken off it.
Finding TestFading(const FittedModel& model, Eigen::VectorXd& residual, ErrorLevel& level);

}  // namespace warmjoint
