// What a robot cannot log: known to simulations alone, seen by score alone.
#pragma once

#include <Eigen/Core>
#include <string>

#include "models/foundation/field.h"
#include "models/friction/friction_description.h"
#include "models/recording/measurements.h"

namespace warmjoint::inline sim {

/// The truth behind Measurements of the same N samples.
struct Truth {
  FrictionDescription friction;
  double initial_energy = 0;  // E(0), N.m or N
  double torque_noise = 0;    // standard deviation of the noise on the stored torque, N.m or N
  /// Of the part of it that remembers, exp(-t/correlation_time), N.m or N.
  double coloured_noise = 0;
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

/// How well a driven joint followed its motion.
struct Following {
  /// Of the time in which the motion asks for a constant speed other than 0, the share in which the
  /// joint moved within 5 % of it; 1 where it asks for none.
  double share = 1;
  double bandwidth = 0;   // of the drive, rad/s; 0: the plant has none, and follows exactly
  double sufficient = 0;  // bandwidth that does (SufficientBandwidth), rad/s
  double timestep = 0;    // s, whole part of the scenario's that allows it; 0: the scenario's does

  /// Whether the recording holds the motion that was asked for.
  bool Follows() const { return share >= 0.8; }
};

/// The two halves of a simulated run, kept apart by type: no identifier sees the second.
struct Recording {
  Measurements measurements;
  Truth truth;
  Following following{};
};

// As JSON: the truth.json of a simulated recording. SI; numbers read back bit for bit.

/// Writes truth.json as a whole. Throws BadInput where the file cannot be written.
void WriteTruth(const Truth& truth, const std::string& path);

/// Reads it. Missing or unknown keys, arrays of unlike lengths and wrong types throw BadInput with their place.
Truth ReadTruth(const std::string& path);

}  // namespace warmjoint::inline sim
