// A joint that is driven to and fro, and the path that it travelled.
#pragma once

#include <warmjoint/recording.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "models/foundation/random_stream.h"

namespace warmjoint::test {

/// A joint that holds speeds of U(0.1, 1) rad/s in turn both ways, with ramps between them, logged
/// without a velocity; ramps begin at a sample and end between two.
struct Drive {
  double rate = 20;         // Hz
  double hold = 5;          // s
  double acceleration = 3;  // rad/s^2; 0: jumps
  double pause = 0;         // s at rest between two speeds
  double ripple = 0;        // of the speed, three waves a second
  double resolution = 0;    // rad
  double origin = 0;        // rad
  std::uint64_t seed = 1;
  int speeds = 30;
};

struct Driven {
  Measurements log;
  Eigen::VectorXd path;      // [N] rad, travelled until each sample
  Eigen::VectorXd velocity;  // [N] rad/s
};

/// Integrated in steps of a thousandth of a sample or less.
inline Driven Carried(const Drive& drive) {
  RandomStream random({drive.seed, 5}, Stream::test);
  const auto n = static_cast<Eigen::Index>(drive.speeds * drive.hold * drive.rate);
  const int parts = std::max(10, static_cast<int>(2000 / drive.rate));
  const double dt = 1 / drive.rate / parts;
  Driven driven{{}, Eigen::VectorXd(n), Eigen::VectorXd(n)};
  driven.log.time.resize(n);
  driven.log.position.resize(n);
  driven.log.torque = Eigen::VectorXd::LinSpaced(n, 0, 1);
  double v = 0, position = 0, path = 0, target = 0, until = 0;
  int sign = 1;
  for (Eigen::Index i = 0; i < n; ++i) {
    for (int k = 0; k < parts; ++k) {
      const double t = (static_cast<double>(i) + static_cast<double>(k) / parts) / drive.rate;
      if (t >= until - 1e-9) {
        target = sign * (0.1 + 0.9 * random.Uniform());
        sign = -sign;
        until += drive.hold;
      }
      const double left = until - t;
      const double wanted =
          left < drive.pause ? 0 : target * (1 + drive.ripple * std::sin(6 * std::numbers::pi * t));
      const double most = drive.acceleration > 0 ? drive.acceleration * dt : 10;
      const double next = v + std::clamp(wanted - v, -most, most);
      if (k == 0) {
        driven.log.time[i] = t;
        driven.log.position[i] = position;
        driven.path[i] = path;
        driven.velocity[i] = v;
      }
      position += 0.5 * (v + next) * dt;
      path += 0.5 * std::abs(v + next) * dt;
      v = next;
    }
  }
  if (drive.resolution > 0) {
    driven.log.position =
        drive.resolution * (driven.log.position / drive.resolution).array().round();
  }
  driven.log.position.array() += drive.origin;
  return driven;
}

}  // namespace warmjoint::test
