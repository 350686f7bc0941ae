// A compensator through calls of any numbers: velocity, torque, dt, place and rests, eight doubles a call.
#include <warmjoint/compensate.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "models/friction/compensator.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace warmjoint;

/// Two stages, a slope that follows the heat, load and two maps.
const Compensator& Fresh() {
  static const Compensator fresh = [] {
    Friction friction{"stribeck",
                      {{"viscous", 5},
                       {"coulomb", 15},
                       {"static", 18},
                       {"stribeck_velocity", 0.1},
                       {"stribeck_exponent", 1.4}},
                      Thermal{-0.75, 600}};
    friction.second_thermal = Thermal{0.2, 3600};
    friction.viscous_per_energy = 0.1;
    friction.load_gain = 0.1;
    friction.gear = 11;
    friction.maps = {{{{MapQuantity::position, EvenAxis(-1, 1, 3)}}, {}, {1, -2, 1}},
                     {{{MapQuantity::motor_position, CircleAxis(6.283185307179586, 3)},
                       {MapQuantity::velocity, SpeedAxis(0.1, 0.5, 1)}},
                      KernelKind::plain,
                      {1, -1, 2, 0, -20, 1}}};
    return Compensator(friction, {.noise = 0.5});
  }();
  return fresh;
}

/// The friction that the model has at a velocity, N.m.
double FrictionAt(const wj_joint& joint, double v, double correction) {
  return std::abs(wj_sliding(&joint, v, correction));
}

}  // namespace

void warmjoint::fuzz::Read(std::string_view bytes) {
  Compensator compensator = Fresh();
  wj_joint& joint = compensator.joint();
  std::array<double, 8> call;
  for (; bytes.size() >= sizeof call; bytes.remove_prefix(sizeof call)) {
    std::memcpy(call.data(), bytes.data(), sizeof call);
    const auto& [velocity, torque, dt, position, motor, load, rise, other] = call;
    joint.at = {position, motor, load, rise, std::signbit(other) ? NAN : other};

    // now and then power is off
    if (other > 1e6) {
      const wj_state kept = joint.state;
      wj_begin(&joint, &compensator.joint().friction);
      Require(wj_restore(&joint, &kept, other > 1e12 ? NAN : other) == 1);
      continue;
    }
    const double correction = joint.state.correction;
    const double given = wj_step(&joint, velocity, torque, dt);

    // finite, to the side of the velocity or 0, and no more than the share of the friction
    const double asked = std::isnan(joint.at.reference) ? velocity : joint.at.reference;
    const double by = std::isnan(asked) ? 0 : std::clamp(asked, -1000.0, 1000.0);
    Require(std::isfinite(given) && given * by >= 0);
    Require(std::abs(given) <= 0.9 * FrictionAt(joint, by, correction) * (1 + 1e-12));
    const wj_state& state = joint.state;
    Require(std::isfinite(state.energy + state.second_energy + state.correction));
    Require(state.variance >= 0 && std::isfinite(state.variance) && joint.found.loss >= 0);
  }
}
