// Which samples of a log take part in a fit.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/recording/measurements.h"

namespace warmjoint::inline models {

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

/// The same selection without samples of velocity 0. Friction at v = 0 is whatever holds the joint,
/// not what the law gives, so that such a sample tells a fit nothing; it still warms or cools the
/// joint.
inline Selection WithoutRest(const Selection& selection, const Measurements& measurements) {
  return {selection.keep && measurements.velocity.array() != 0, selection.segments};
}

}  // namespace warmjoint::inline models
