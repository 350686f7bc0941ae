// The unknowns of a fit: what one is, in one place for the fit, its report and its covariance.
#pragma once

#include <warmjoint/friction.h>

#include <optional>
#include <string>

namespace warmjoint {

/// The part of the model to which an unknown belongs.
enum class Role { law, load, heat, start, jump, gravity, inertia, lag, delay };

/// Whether a role is part of Fn, the friction of a cold joint: law and load, whose values have physical bounds.
inline bool IsNominal(Role role) { return role == Role::law || role == Role::load; }

/// The coordinate x in which a fit works, and the one whose errors are about normal: the value for
/// both, the logarithm of a positive value for both, or x the value and its logarithm normal.
enum class Coordinate { value, logarithm, positive };

/// What is known of an unknown before the data, in its coordinate.
struct Normal {
  double mean = 0;
  double deviation = 1;
};

/// A row of the table of unknowns. The fit works in x: the value, or its logarithm.
struct Unknown {
  std::string name;  // in estimate.json; empty: a nuisance that reports leave out
  Role role = Role::law;
  std::string unit;
  Coordinate coordinate = Coordinate::value;
  double lower = -kInfinity, upper = kInfinity;  // physical bounds of the value
  double start = 0;                              // x at which the fit begins
  std::optional<Normal> prior{};
  double largest_step = kInfinity;  // of x in one iteration, where the model is not linear
  int displacement_power = 0;       // of rad or m in the unit, in addition to the unit of torque
  int time_power = 0;               // of s
  LawPart part = LawPart::other;    // of a row of the law
};

}  // namespace warmjoint
