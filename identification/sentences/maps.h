// Of maps, and of the law and the warming that are fitted with them.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/prepared_log.h>

#include <string>
#include <utility>
#include <vector>

#include "identification/fit.h"

namespace warmjoint {

inline constexpr const char* kWithoutWarming = "without warming: ";  // why not
inline constexpr const char* kMapHoldsGravity =
    "the map holds what acts alike in both directions, as gravity does, which is no friction; add "
    "--gravity sincos";
inline constexpr const char* kMotorTurnsWithJoint =
    "the motor is taken to turn with the joint: give --gear, or log motor_position";

/// Of a parameter of the law that was set to its lower bound.
std::string ExplainHeldBesideMaps(const FitParameter& parameter);
/// Of parameters, by their names, that maps can imitate.
std::string ExplainImitated(const std::vector<std::string>& names);
/// Of friction below 0 at a speed, beside the gravity that the fit has.
std::string ExplainDrivingFriction(const FrictionAtSpeed& at, const LogSamples& measurements,
                                   const Fit& fit);
/// Of places without data (NameHoles).
std::string ExplainHoles(const std::vector<std::string>& holes);
/// Of a motor's ripple. harmonics: how often a turn, and amplitude in `unit`
std::string ExplainMotorRipple(bool forwards, const std::vector<std::pair<int, double>>& harmonics,
                               const std::string& unit);

/// Of warming that was fitted with maps, and of maps over the energy that it gives.
std::string ExplainWarmingBesideMaps(int iterations);
std::string ExplainMapsOverEnergy(int rounds);

}  // namespace warmjoint
