// What poor sensors, clocks and files make of a log.
#pragma once

#include <warmjoint/simulation.h>

#include "models/foundation/random_stream.h"
#include "scenarios/disturbances.h"

namespace warmjoint::inline sim {

/// The motion as poorer sensors tell it: filtered, stale, coarse or missing (velocity_filter, stale_position, encoder,
/// without_velocity).
void DisturbMotion(const Disturbances& disturbances, Measurements& log);

/// Faults of SensorFaults, in the order of their way: drift and factors of the torque, columns that stick, limits, late
/// samples; then scales; then what the file leaves out and how its clock runs. Truth loses the samples that the log loses.
void SpoilLog(const SensorFaults& faults, Simulation& recording);

/// Leaves out single samples by chance, and their truth.
void LoseSamples(const LostSamples& lost, RandomStream random, Simulation& recording);

}  // namespace warmjoint::inline sim
