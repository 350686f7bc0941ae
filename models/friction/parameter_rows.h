// Rows that the parameter tables of several laws share.
#pragma once

#include "models/friction/parameter_info.h"

namespace warmjoint::inline models {

inline constexpr ParameterInfo kViscousRow{
    .name = "viscous",
    .symbol = "kv",
    .unit = kViscousUnit,
    .lower = 0,
    .upper = kInfinity,
    .default_value = 0,
    .meaning = "slope over speed",
};

inline constexpr ParameterInfo kCoulombRow{
    .name = "coulomb",
    .symbol = "kc",
    .unit = kTorqueUnit,
    .lower = 0,
    .upper = kInfinity,
    .default_value = 0,
    .meaning = "level at any speed",
};

inline constexpr ParameterInfo kStaticRow{
    .name = "static",
    .symbol = "ks",
    .unit = kTorqueUnit,
    .lower = 0,
    .upper = kInfinity,
    .default_value = 0,
    .meaning = "level at rest, >= coulomb",
};

inline constexpr ParameterInfo kStribeckVelocityRow{
    .name = "stribeck_velocity",
    .symbol = "vs",
    .unit = kVelocityUnit,
    .lower = kSmallestPositive,
    .upper = kInfinity,
    .default_value = 0.1,
    .meaning = "speed over which static falls to coulomb",
};

inline constexpr ParameterInfo kBristleStiffnessRow{
    .name = "bristle_stiffness",
    .symbol = "sigma0",
    .unit = kStiffnessUnit,
    .lower = kSmallestPositive,
    .upper = kInfinity,
    .default_value = 1,
    .meaning = "slope of the force over travel before sliding",
};

}  // namespace warmjoint::inline models
