// The table of a fit's unknowns: what one is and where it stands, in one place for the fit, its report and its covariance.
#pragma once

#include <warmjoint/friction.h>

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

namespace warmjoint {

/// The part of the model to which an unknown belongs. Rows with one role stand side by side in a table.
enum class Role {
  law,
  load,
  gain,           // k of the heat
  time_constant,  // tau of the heat
  start,          // E(0) of a recording
  jump,           // of E
  gravity,        // and all else that makes no heat, of a model
  inertia,
  lag,
  delay,
  weight,     // of a kernel of a map
  scale,      // of a given rigid torque
  direction,  // in which a given rigid torque may be wrong
  ripple,     // of a gear, by harmonics
  offset      // of the torque
};

/// Whether a role is part of Fn, the friction of a cold joint: law and load, whose values have physical bounds.
inline bool IsNominal(Role role) { return role == Role::law || role == Role::load; }
inline bool IsHeat(Role role) { return role == Role::gain || role == Role::time_constant; }

/// The coordinate x in which a fit works, and the one whose errors are about normal: the value for
/// both, the logarithm of a positive value for both, or x the value and its logarithm normal.
enum class Coordinate { value, logarithm, positive };

/// What is known of an unknown before the data, in its coordinate.
struct Normal {
  double mean = 0;
  double deviation = 1;
};

/// A row of the table: an unknown, and what was found for it. The fit works in x: the value, or its logarithm.
struct Unknown {
  std::string name;  // in estimate.json; empty: a nuisance that reports leave out
  Role role = Role::law;
  std::string unit;
  Coordinate coordinate = Coordinate::value;
  double lower = -kInfinity, upper = kInfinity;  // physical bounds of the value
  double value = 0;                              // with which the fit begins; then what it found
  std::optional<Normal> prior{};
  double largest_step = kInfinity;  // of x in one iteration, where the model is not linear
  int displacement_power = 0;       // of rad or m in the unit, in addition to the unit of torque
  int time_power = 0;               // of s
  LawPart part = LawPart::other;    // of a row of the law
  bool estimated = true;            // has a column of the Jacobian; else its value was given
  bool has_interval = true;         // false where only a prior or an option determines it

  /// x at the value; of a logarithm that of its size.
  double X() const {
    return coordinate == Coordinate::logarithm ? std::log(std::abs(value)) : value;
  }
  /// The value at x, of the sign that it has.
  double ValueAt(double x) const {
    return coordinate == Coordinate::logarithm ? std::copysign(std::exp(x), value) : x;
  }
  /// Where the value stands in a friction, whose heat and law it must have; null of a row that is no part of one.
  double* PlaceIn(Friction& friction) const;
  /// Derivative of the value by the coordinate x, at a value.
  double ValueByCoordinate(double at) const { return coordinate == Coordinate::logarithm ? at : 1; }
};

/// Rows that no report has, of which nothing is known.
std::vector<Unknown> Unnamed(Role role, Eigen::Index count);

/// Unknowns that are contiguous in x.
struct Slice {
  Eigen::Index begin = 0, size = 0;

  constexpr Eigen::Index end() const { return begin + size; }
  /// Each of them. [size]
  std::vector<Eigen::Index> Places() const {
    std::vector<Eigen::Index> places(static_cast<std::size_t>(size));
    std::iota(places.begin(), places.end(), begin);
    return places;
  }
  /// This part of a vector over x. [size]
  Eigen::VectorXd Of(const Eigen::VectorXd& x) const { return x.segment(begin, size); }
  /// The same to be written to.
  auto In(Eigen::VectorXd& x) const { return x.segment(begin, size); }
  /// This part of a matrix over x and x. [size x size]
  Eigen::MatrixXd Block(const Eigen::MatrixXd& of) const {
    return of.block(begin, begin, size, size);
  }
};

/// The places of a table's rows with a role; where it has none, none at its end.
Slice SliceOf(Role role, const std::vector<Unknown>& table);

}  // namespace warmjoint
