// One row of a parameter table.
#pragma once

#include <limits>
#include <string_view>

#include "models/friction/joint_kind.h"

namespace warmjoint::inline models {

/// Whether files must give a parameter or may leave it at its default.
enum class Given { always, or_default };

/// What of its law's force a parameter is, for code that must tell one parameter from another, whatever the law. A law
/// has at most one of each, but for a level to each direction.
enum class LawPart {
  other,
  slope,       // over speed
  level,       // while it slides
  rest_level,  // at rest
  rest_rise,   // of the level at rest over that while it slides
  bristle,     // stiffness of the law's own
};

/// What is known of a parameter before any data: every law and the thermal state carry a table of
/// these, from which checks, regressors, documentation and plots are made.
struct ParameterInfo {
  std::string_view name;    // as in files and on the command line
  std::string_view symbol;  // as in the paper
  JointUnit unit;
  double lower;  // smallest allowed value
  double upper;  // largest allowed value
  double default_value;
  std::string_view meaning;  // one short phrase
  Given given = Given::always;
  LawPart part = LawPart::other;
};

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Lower bound of what must be positive, in SI.
inline constexpr double kSmallestPositive = 1e-9;

}  // namespace warmjoint::inline models
