// Which samples obey Eq. (6): constant speed, so that torque = gravity + friction.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/dataset/measurements.h"

namespace warmjoint {

/// A run of samples at one constant speed.
struct Segment {
  Eigen::Index begin = 0;  // first sample
  Eigen::Index end = 0;    // one past the last
  double velocity = 0;     // mean, rad/s or m/s; 0 at rest
};

/// Samples that take part in fits. The thermal filter always runs over all samples: those left out
/// still warm the joint (W of a rest is 0, W of an acceleration is not).
struct Selection {
  Eigen::Array<bool, Eigen::Dynamic, 1> keep;  // [N]
  std::vector<Segment> segments;               // moving segments, in order of time

  Eigen::Index count() const { return keep.count(); }
};

/// Keeps the samples that move at a constant speed; rests and accelerations are left out.
/// Works on plateaus of the velocity, so that a jump between two plateaus costs no sample.
Selection SelectConstantSpeed(const Measurements& measurements);

/// Keeps every sample with v != 0, for data that is known to satisfy Eq. (6) throughout.
Selection SelectMoving(const Measurements& measurements);

}  // namespace warmjoint
