// What the preparation of a log means for an estimate.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/prepared_log.h>

namespace warmjoint {

/// Says what was done to the velocity; where more than 0.1 % of a slope's attenuation is left, the
/// intervals of viscous and of the levels reach as far as that moves them, and a warning says so.
void TellVelocity(const VelocityNoise& taken, JointKind joint, Estimate& estimate);

/// That, in an estimate that is ok. Warns in an estimate with warming how far the gain may be off
/// where reversals happen between two samples, unless that is below half a per cent.
void TellPreparation(const PreparedLog& log, Estimate& estimate);

}  // namespace warmjoint
