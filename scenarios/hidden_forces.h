// Forces of a joint that no model of an identifier holds. All zero: none.
#pragma once

namespace warmjoint::inline scenarios {

/// Behind each change of direction the friction lacks a level until the joint has gone some way, as with play in a gear.
struct Backlash {
  double level = 0;  // N.m or N
  double way = 0;    // rad or m

  bool operator==(const Backlash&) const = default;
};

/// Behind each change of direction the friction lacks level exp(-s / way) after the way s, as bristles that bend leave it.
struct Hysteresis {
  double level = 0;  // N.m or N
  double way = 1;    // rad or m

  bool operator==(const Hysteresis&) const = default;
};

/// Viscous friction that follows the speed late, as a film of oil does: slope (u - |v|) joins the level, u being |v| behind a
/// first-order low-pass.
struct Memory {
  double slope = 0;          // N.m.s/rad or N.s/m
  double time_constant = 1;  // s

  bool operator==(const Memory&) const = default;
};

/// Friction that grows with the square of the speed: coefficient v |v|.
struct QuadraticDrag {
  double coefficient = 0;  // N.m.s^2/rad^2 or N.s^2/m^2

  bool operator==(const QuadraticDrag&) const = default;
};

/// Ripple of the level over position, alike in both directions: amplitude sin(2 pi p / period).
struct Ripple {
  double amplitude = 0;  // N.m or N
  double period = 1;     // rad or m

  bool operator==(const Ripple&) const = default;
};

/// A spring between joint and base: stiffness p.
struct Spring {
  double stiffness = 0;  // N.m/rad or N/m

  bool operator==(const Spring&) const = default;
};

/// The torque that accelerates a mass: inertia dv/dt; between the samples where speeds are held.
struct Inertia {
  double inertia = 0;  // kg.m^2 or kg

  bool operator==(const Inertia&) const = default;
};

struct HiddenForces {
  Backlash backlash;
  Hysteresis hysteresis;
  Memory memory;
  QuadraticDrag quadratic_drag;
  Ripple ripple;
  Spring spring;
  Inertia inertia;

  bool operator==(const HiddenForces&) const = default;
};

}  // namespace warmjoint::inline scenarios
