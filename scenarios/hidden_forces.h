// Forces of a joint that no model of an identifier holds. All zero: none.
#pragma once

#include <warmjoint/field.h>

namespace warmjoint {

/// Behind each change of direction the friction lacks a level until the joint has gone some way, as with play in a gear.
struct Backlash {
  double level = 0;  // N.m or N
  double way = 0;    // rad or m

  template <class A>
  void Serialize(A* a) {
    a->Field("level", &level, {.unit = "N.m", .needed = kGiveNumber});
    a->Field("way", &way, {.unit = "rad", .bounds = {.at_least = 0}, .needed = kGiveNumber});
  }

  bool operator==(const Backlash&) const = default;
};

/// Behind each change of direction the friction lacks level exp(-s / way) after the way s, as bristles that bend leave it.
struct Hysteresis {
  double level = 0;  // N.m or N
  double way = 1;    // rad or m

  template <class A>
  void Serialize(A* a) {
    a->Field("level", &level, {.unit = "N.m", .needed = kGiveNumber});
    a->Field("way", &way, {.unit = "rad", .bounds = {.above = 0}, .needed = kGiveNumber});
  }

  bool operator==(const Hysteresis&) const = default;
};

/// Viscous friction that follows the speed late, as a film of oil does: slope (u - |v|) joins the level, u being |v| behind a
/// first-order low-pass.
struct Memory {
  double slope = 0;          // N.m.s/rad or N.s/m
  double time_constant = 1;  // s

  template <class A>
  void Serialize(A* a) {
    a->Field("slope", &slope, {.unit = "N.m.s/rad", .needed = kGiveNumber});
    a->Field("time_constant", &time_constant,
             {.unit = "s", .bounds = {.above = 0}, .needed = kGiveNumber});
  }

  bool operator==(const Memory&) const = default;
};

/// Friction that grows with the square of the speed: coefficient v |v|.
struct QuadraticDrag {
  double coefficient = 0;  // N.m.s^2/rad^2 or N.s^2/m^2

  template <class A>
  void Serialize(A* a) {
    a->Field("coefficient", &coefficient, {.unit = "N.m.s^2/rad^2", .needed = kGiveNumber});
  }

  bool operator==(const QuadraticDrag&) const = default;
};

/// Ripple of the level over position, alike in both directions: amplitude sin(2 pi p / period).
struct Ripple {
  double amplitude = 0;  // N.m or N
  double period = 1;     // rad or m

  template <class A>
  void Serialize(A* a) {
    a->Field("amplitude", &amplitude, {.unit = "N.m", .needed = kGiveNumber});
    a->Field("period", &period, {.unit = "rad", .bounds = {.above = 0}, .needed = kGiveNumber});
  }

  bool operator==(const Ripple&) const = default;
};

/// A spring between joint and base: stiffness p.
struct Spring {
  double stiffness = 0;  // N.m/rad or N/m

  template <class A>
  void Serialize(A* a) {
    a->Field("stiffness", &stiffness, {.unit = "N.m/rad", .needed = kGiveNumber});
  }

  bool operator==(const Spring&) const = default;
};

/// The torque that accelerates a mass: inertia dv/dt; between the samples where speeds are held.
struct Inertia {
  double inertia = 0;  // kg.m^2 or kg

  template <class A>
  void Serialize(A* a) {
    a->Field("inertia", &inertia,
             {.unit = "kg.m^2", .bounds = {.at_least = 0}, .needed = kGiveNumber});
  }

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

  template <class A>
  void Serialize(A* a) {
    constexpr FieldInfo absent{.at_default = AtDefault::left_out};
    a->Field("backlash", &backlash, absent);
    a->Field("hysteresis", &hysteresis, absent);
    a->Field("memory", &memory, absent);
    a->Field("quadratic_drag", &quadratic_drag, absent);
    a->Field("ripple", &ripple, absent);
    a->Field("spring", &spring, absent);
    a->Field("inertia", &inertia, absent);
  }

  bool operator==(const HiddenForces&) const = default;
};

}  // namespace warmjoint
