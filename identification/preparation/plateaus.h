// Runs of samples around one speed: candidates for constant speed.
#pragma once

#include <warmjoint/recording.h>

#include <vector>

#include "identification/preparation/velocity_scale.h"

namespace warmjoint {

/// Cuts the velocity into runs that stay within scale.Band of their mean: a run ends at a sample
/// that leaves the band, at a jump between two steady speeds, or at a gap in time (more than three
/// median steps). Runs that a few outliers alone divide are joined. Together they hold every
/// sample, so ramps come as many short runs. One pass.
std::vector<Segment> CutIntoRuns(const Measurements& measurements, const VelocityScale& scale);

}  // namespace warmjoint
