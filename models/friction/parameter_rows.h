// Parameter tables of laws: rows that several share, and what code must know of a table.
#pragma once

#include <warmjoint/friction.h>

#include <optional>
#include <string_view>

namespace warmjoint {

// Where a row says nothing else, its number is at least 0, and 0 by default.

inline constexpr ParameterInfo kViscousRow{
    .name = "viscous",
    .symbol = "kv",
    .unit = kViscousUnit,
    .meaning = "slope over speed",
    .part = LawPart::slope,
};

inline constexpr ParameterInfo kCoulombRow{
    .name = "coulomb",
    .symbol = "kc",
    .unit = kTorqueUnit,
    .meaning = "level at any speed",
    .part = LawPart::level,
};

inline constexpr ParameterInfo kCoulombPositiveRow{
    .name = "coulomb_positive",
    .symbol = "kc+",
    .unit = kTorqueUnit,
    .meaning = "level for v > 0",
    .part = LawPart::level,
};

inline constexpr ParameterInfo kCoulombNegativeRow{
    .name = "coulomb_negative",
    .symbol = "kc-",
    .unit = kTorqueUnit,
    .meaning = "level for v < 0",
    .part = LawPart::level,
};

inline constexpr ParameterInfo kStaticRow{
    .name = "static",
    .symbol = "ks",
    .unit = kTorqueUnit,
    .meaning = "level at rest, >= coulomb",
    .part = LawPart::rest_level,
};

inline constexpr ParameterInfo kStaticRiseRow{
    .name = "static_rise",
    .symbol = "kr",
    .unit = kTorqueUnit,
    .meaning = "level at rest less that at any speed, in both directions",
    .part = LawPart::rest_rise,
};

inline constexpr ParameterInfo kStribeckVelocityRow{
    .name = "stribeck_velocity",
    .symbol = "vs",
    .unit = kVelocityUnit,
    .lower = kSmallestPositive,
    .default_value = 0.1,
    .meaning = "speed over which static falls to coulomb",
};

inline constexpr ParameterInfo kStribeckExponentRow{
    .name = "stribeck_exponent",
    .symbol = "delta",
    .unit = {"1", "1"},
    .lower = 0.1,
    .upper = 10,
    .default_value = 2,
    .meaning = "sharpness of that fall",
    .given = Given::or_default,
};

inline constexpr ParameterInfo kBristleStiffnessRow{
    .name = "bristle_stiffness",
    .symbol = "sigma0",
    .unit = kStiffnessUnit,
    .lower = kSmallestPositive,
    .default_value = 1,
    .meaning = "slope of the force over travel before sliding",
    .part = LawPart::bristle,
};

inline constexpr ParameterInfo kBristleDampingRow{
    .name = "bristle_damping",
    .symbol = "sigma1",
    .unit = kViscousUnit,
    .meaning = "damping of the bristle's motion",
};

/// What the parameter of that name is in the laws that have it, for what was read from a file;
/// LawPart::other where none has.
LawPart PartOf(std::string_view name);

/// The place in the law's table of the first parameter that is that part; nothing where there is
/// none.
std::optional<size_t> PlaceOf(LawPart part, const Law& law);

}  // namespace warmjoint
