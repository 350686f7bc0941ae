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

  template <class A>
  void Serialize(A* a) {
    // friction, start, plant and noise; its colour where it has any
    constexpr std::string_view needed = "is it a truth file?";
    a->Field("friction", &friction, {.needed = needed});
    a->Field("initial_energy", &initial_energy, {.unit = "N.m", .needed = needed});
    a->Field("plant", &plant, {.needed = needed});
    a->Field("torque_noise", &torque_noise, {.unit = "N.m", .needed = needed});
    constexpr auto left_out = AtDefault::left_out;
    a->Field("coloured_noise", &coloured_noise, {.unit = "N.m", .at_default = left_out});
    a->Field("correlation_time", &correlation_time, {.unit = "s", .at_default = left_out});

    // columns of one length
    a->Field("velocity", &velocity, {.unit = "rad/s", .needed = needed});
    a->Field("force", &force, {.unit = "N.m", .needed = needed});
    a->Field("loss", &loss, {.unit = "W", .needed = needed});
    a->Field("energy", &energy, {.unit = "N.m", .needed = needed});
    constexpr std::string_view like = "as long as velocity: all arrays must be of one length";
    a->Check(force.size() == velocity.size(), "force", like);
    a->Check(loss.size() == velocity.size(), "loss", like);
    a->Check(energy.size() == velocity.size(), "energy", like);
  }
};

}  // namespace warmjoint::inline sim
