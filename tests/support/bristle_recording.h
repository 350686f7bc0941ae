// A joint with LuGre's bristle, and a motion that shows it, stepped finely as the plugin steps it.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>

#include "models/friction/joint_friction.h"
#include "tests/support/warm_recording.h"

namespace warmjoint::test {

/// The joint of StribeckJoint with a bristle that bends by 10 mrad.
inline Friction LuGreJoint() {
  return {"lugre",
          {{"viscous", 5},
           {"coulomb", 15},
           {"static", 20},
           {"stribeck_velocity", 0.05},
           {"bristle_stiffness", 2000},
           {"bristle_damping", 40}},
          {}};
}

/// The same with a level of 15 N.m forwards and 12 N.m backwards.
inline Friction TwoLevelLuGreJoint() {
  Friction friction = TwoLevelStribeckJoint();
  friction.law = "asymmetric_lugre";
  friction.parameters.erase("stribeck_exponent");
  friction.parameters["bristle_stiffness"] = 2000;
  friction.parameters["bristle_damping"] = 40;
  return friction;
}

/// Velocity over time in turns of 4 s, from the second 0 on, rad/s: to and fro at one of the speeds
/// 0.005 to 1 rad/s, even in their logarithm, joined by ramps of 0.1 s; then, where `wobbles`, 1 s
/// of a sinusoid of 20 mrad at 1 Hz and 1 s of 6 mrad at 4 Hz.
class TurningMotion {
 public:
  TurningMotion(double duration, std::uint64_t seed, bool wobbles = true) : wobbles_(wobbles) {
    RandomStream random({seed, 0}, Stream::motion);
    for (int i = 0; i <= duration / kTurn + 1; ++i) {
      speeds_.push_back(0.005 * std::pow(200, random.Uniform(0, 1)));
    }
  }

  double operator()(double time) const {
    const double turn = std::max(0.0, std::floor(time / kTurn)), t = time - kTurn * turn;
    const double speed = speeds_[static_cast<size_t>(turn)];
    const double pi = std::numbers::pi;
    if (wobbles_ && t > 3) return 0.006 * 8 * pi * std::sin(8 * pi * (t - 3));
    if (wobbles_ && t > 2) return 0.02 * 2 * pi * std::sin(2 * pi * (t - 2));
    // up, along, down through 0, back, up to 0
    const double half = wobbles_ ? 1 : 2;
    const double s = t < half ? t : 2 * half - t;
    return (t < half ? speed : -speed) *
           std::min({1.0, s / 0.1, (half - std::abs(t - half)) / 0.1, std::abs(half - t) / 0.1});
  }

 private:
  static constexpr double kTurn = 4;  // s
  bool wobbles_;
  std::vector<double> speeds_;
};

/// What friction, stepped in 0.1 ms from a relaxed bristle, and an inertia (kg.m^2) give along a
/// motion, with white noise (N.m). rate: Hz.
inline Measurements RecordBristle(const Friction& friction,
                                  const std::function<double(double)>& motion, double duration,
                                  double rate, double inertia, double noise, std::uint64_t seed) {
  const double h = 1e-4;
  JointFriction joint(friction);
  joint.SetTimestep(h);
  const auto every = static_cast<int>(std::lround(1 / (rate * h)));
  const auto n = static_cast<Eigen::Index>(duration * rate);
  Eigen::VectorXd velocity(n), torque(n);
  RandomStream random({seed, 0}, Stream::torque_noise);
  FrictionState state;
  for (int k = 0; k <= (n - 1) * every; ++k) {
    // the step that ends at t; a bristle of any stiffness is exact, whatever the inertia
    const double t = k * h, before = std::max(0.0, t - h);
    const FrictionStep step =
        joint.Step(state, {.velocity = k > 0 ? motion(t - 0.5 * h) : 0.0, .inertia = 1e6});
    state = step.next;
    if (k % every != 0) continue;
    const double a = (motion(t + h) - motion(before)) / (t + h - before);
    velocity[k / every] = motion(t);
    torque[k / every] = step.force + inertia * a + noise * random.Normal();
  }
  return Record(1 / rate, velocity, torque);
}

}  // namespace warmjoint::test
