// A recording as the forward model reads it.
#pragma once

#include <warmjoint/recording.h>

#include "models/friction/along_motion.h"

namespace warmjoint {

/// How a law's own bristle is bent at the start of each recording: as in steady sliding, or as the
/// measured torque tells.
enum class BristleStart { sliding, torque };

/// Time, velocity, positions, load and starts of a recording of N samples. The motor position is
/// the logged one, else the recording's gear times the joint's.
JointCourse CourseOf(const Measurements& measurements,
                     BristleStart bristle = BristleStart::sliding);

/// The friction that a recording's motion gives: AlongMotion over CourseOf.
Prediction PredictFriction(const Friction& friction, const Measurements& measurements,
                           const CourseStart& start = {},
                           BristleStart bristle = BristleStart::sliding);

}  // namespace warmjoint
