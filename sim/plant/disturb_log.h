// Disturbances that show in the log alone.
#pragma once

#include <warmjoint/simulation.h>

#include <Eigen/Core>

#include "scenarios/scenario.h"

namespace warmjoint {

/// Adds to the logged torque what the scenario disturbs it by: a lag, forces that no model holds, outliers, coloured and
/// uneven noise, a periodic torque; makes of the motion what poorer sensors log; and spoils what is left as faulty
/// sensors, clocks and files do; truth loses the samples that the log loses. Random numbers come from streams of their
/// own, so that they leave all others as they are. Coloured noise joins Truth.torque_noise; outliers and uneven noise,
/// being no noise of one size, do not. position: [N] true, rad or m; acceleration: [N] true, rad/s^2 or m/s^2, or empty:
/// as neighbouring samples show it.
void DisturbLog(const Scenario& scenario, std::uint64_t realization, Simulation& recording,
                const Eigen::VectorXd& position, const Eigen::VectorXd& acceleration = {});

}  // namespace warmjoint
