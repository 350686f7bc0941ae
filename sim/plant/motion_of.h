// The motion of a recording, to be carried out again.
#pragma once

#include <warmjoint/recording.h>

#include "scenarios/motion.h"

namespace warmjoint {

/// A velocity by its corners that follows the recording: the segments at constant speed exactly;
/// between them up to eight corners at the recorded mean velocities, moved together so that the way
/// from segment to segment is the recorded one. The start is the first position.
/// Throws BadInput where the recording has no segment at constant speed.
Motion MotionOf(const Measurements& measurements, const Selection& selection);

}  // namespace warmjoint
