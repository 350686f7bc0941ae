// The two halves of a simulated run, kept apart by type.
#pragma once

#include "models/recording/measurements.h"
#include "sim/truth/truth.h"

namespace warmjoint::inline sim {

/// How well a driven joint followed its motion.
struct Following {
  /// Of the time in which the motion asks for a constant speed other than 0, the share in which the
  /// joint moved within 5 % of it; 1 where it asks for none.
  double share = 1;
  double bandwidth = 0;   // of the drive, rad/s; 0: the plant has none, and follows exactly
  double sufficient = 0;  // bandwidth that does (drive_bandwidth.h), rad/s
  double timestep = 0;    // s, whole part of the scenario's that allows it; 0: the scenario's does

  /// Whether the recording holds the motion that was asked for.
  bool Follows() const { return share >= 0.8; }
};

struct Recording {
  Measurements measurements;
  Truth truth;
  Following following{};
};

}  // namespace warmjoint::inline sim
