// A log and the samples of it that take part in fits, and what is known of its velocity.
#pragma once

#include "models/recording/measurements.h"
#include "models/recording/selection.h"

namespace warmjoint::inline identification {

struct LogView {
  Measurements measurements;
  Selection selection;
};

/// What tells how a joint moves: a velocity that was logged, or its positions alone.
enum class MotionSource { velocity, positions };

/// What noise of the velocity does to a slope over |v|.
struct VelocityNoise {
  double noise = 0;        // of the velocity within segments, rad/s or m/s
  double attenuation = 0;  // share of a slope over |v| that this noise would hide
  double left = 0;         // the share that the noise of one velocity for a segment still hides
  double mean_speed = 0;   // mean |v| of the kept samples, rad/s or m/s
};

}  // namespace warmjoint::inline identification
