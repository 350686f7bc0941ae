// Identifier `lugre`: the LuGre law, its bristle included.
#pragma once

#include "identification/identifier.h"

namespace warmjoint::inline identification {

/// (kv, kc, ks, vs, sigma0, sigma1, M) = argmin sum ((tau - F - M a) / s)^2, F the LuGre law, or
/// the one with a level for each direction (kc+, kc- and kr for kc and ks), over the recorded motion (bristle_course.h). Starts, stops and turns take part beside the samples
/// kept, since they alone show the bristle (lugre_data.h); M, which acts there too, is estimated
/// beside the law, and so is how far the bristle is bent as each recording begins (lugre_course.h). s is the rms of the residual, one value for the samples kept and one for the
/// others, larger for outliers (Huber's weights), from three passes. Starts from the Stribeck curve
/// of the samples at constant speed, with sigma0 and sigma1 from a grid; the best three are refined
/// by Ceres. Standard deviations and intervals as in uncertainty.h, those of vs, sigma0 and sigma1
/// through their logarithms.
///
/// not_identifiable where the motion cannot tell the law without bristle and fall; where the Stribeck effect is
/// not seen (stribeck_verdict.h); where sigma0 or sigma1 are not known to a factor of e. What the
/// sampling shifts the parameters by counts as a standard deviation beside the noise: a third of
/// what leaving out every other sample changes (Richardson). inadequate_model where friction rises
/// from rest, or turns leave twice as much as constant speeds and 2 % of the torque. The trace
/// holds the grid.
Identifier LuGreIdentifier();

}  // namespace warmjoint::inline identification
