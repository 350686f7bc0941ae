// What a robot cannot log: known to simulations alone, seen by score alone.
#pragma once

#include <Eigen/Core>
#include <string>

#include "models/friction/friction_description.h"

namespace warmjoint::inline sim {

/// The truth behind Measurements of the same N samples.
struct Truth {
  FrictionDescription friction;
  double initial_energy = 0;  // E(0), N.m or N
  double torque_noise = 0;    // standard deviation of the noise on the stored torque, N.m or N
  double coloured_noise =
      0;  // of the part of it that remembers, exp(-t/correlation_time); N.m or N
  double correlation_time = 0;  // s; 0 where all of it is white
  std::string plant;            // plant that made the recording

  Eigen::VectorXd velocity;  // [N] rad/s or m/s, without noise
  Eigen::VectorXd force;     // [N] friction F, N.m or N
  Eigen::VectorXd loss;      // [N] W = |F v|, W
  Eigen::VectorXd energy;    // [N] E, N.m or N
};

}  // namespace warmjoint::inline sim
