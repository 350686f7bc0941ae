// Kinds of friction that a log may show or not.
#pragma once

namespace warmjoint::inline identification {

/// A kind of friction that a motion may show or not.
enum class FrictionKind {
  coulomb,
  viscous_coulomb,
  asymmetric,
  stribeck,
  warm_up,
  position_ripple,
  motor_ripple,
};

}  // namespace warmjoint::inline identification
