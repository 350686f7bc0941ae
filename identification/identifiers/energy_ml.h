// Law and warming together, by maximum likelihood over the closed loop: `energy-ml` alone.
#pragma once

#include "identification/identifier.h"
#include "identification/warming/warm_course.h"

namespace warmjoint::inline identification {

/// (p, k, tau) = argmin sum over the kept samples of (tau - F)^2, F the response of the closed loop
/// (19)-(22) to the recorded velocity: maximum likelihood for white noise on the torque. Needs no
/// start: tau is scanned, then all parameters are refined together. Any law that is linear in its
/// parameters; optionally E(0).
///
/// Standard deviations and 95 % intervals from s^2 (J^T J)^-1 with the exact Jacobian J at the
/// solution. not_identifiable where the motion cannot tell the law's parameters apart, or where the
/// warm-up cannot be seen: its share of the residual is not beyond chance, or tau is not known to
/// better than a factor of about e.
///
/// The identifier of the list can have more: the lag of a torque (energy_ml_behind_lag.h), and maps
/// (energy_ml_with_maps.h).
Identifier EnergyMl();

inline constexpr const char* kEnergyMl = "energy-ml";

/// Its passes after that by squares: under Huber's loss, or on whitened rows where the noise is coloured
/// beyond doubt.
Fit FitFurther(const WarmCourse& course, const WarmStart& start, RobustWarmFit robust);

}  // namespace warmjoint::inline identification
