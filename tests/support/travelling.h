// Recordings of a joint that travels between two limits, with ripple in its friction.
#pragma once

#include <cmath>
#include <numbers>

#include "identification/forward/log_trajectory.h"
#include "tests/support/warm_recording.h"

namespace warmjoint::test {

/// Velocities of travel between -limit and limit (rad) from the lower one on, each speed for one
/// way there and back. n: samples; step: s.
inline Eigen::VectorXd Travel(Eigen::Index n, double step, double limit,
                              const std::vector<double>& speeds) {
  Eigen::VectorXd velocity(n);
  double position = -limit, direction = 1;
  size_t ways = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double v = direction * speeds[ways / 2 % speeds.size()];
    velocity[i] = v;
    position += step * v;
    if (direction * position < limit) continue;
    direction = -direction;
    ++ways;
  }
  return velocity;
}

/// A map that interpolates f over even centres of one quantity, as narrow normalised kernels do.
template <typename F>
FrictionMap Sampled(MapQuantity quantity, GaussianAxis axis, MapFactor factor, F&& f) {
  axis.width *= 0.7;
  FrictionMap map{{{quantity, axis}}, KernelKind::normalised, {}, factor};
  for (const double centre : axis.centres) map.weights.push_back(f(centre));
  return map;
}

/// Ripple at so many cycles for each turn of the motor, N.m.
inline FrictionMap MotorRipple(int multiple, double amplitude) {
  return Sampled(MapQuantity::motor_position, CircleAxis(2 * std::numbers::pi, 64),
                 MapFactor::direction,
                 [=](double angle) { return amplitude * std::sin(multiple * angle); });
}

/// A level that varies over the joint's position, N.m.
inline FrictionMap PositionLevel(double limit, double amplitude) {
  return Sampled(MapQuantity::position, EvenAxis(-limit, limit, 64), MapFactor::direction,
                 [=](double p) { return amplitude * std::sin(4 * p / limit + 0.5); });
}

/// What `friction` gives along a motion that begins at a position, rad, with AR(1) noise.
inline Measurements RecordTravel(const Friction& friction, double step,
                                 const Eigen::VectorXd& velocity, double begin, double noise,
                                 double coefficient, std::uint64_t seed) {
  Measurements m = Record(step, velocity, Eigen::VectorXd::Zero(velocity.size()));
  m.gear = friction.gear;
  m.position.array() += begin;
  m.torque = PredictFriction(friction, LogSamples(m)).force;
  AddNoise(m, noise, coefficient, seed);
  return m;
}

}  // namespace warmjoint::test
