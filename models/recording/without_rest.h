// What fits make of samples of velocity 0.
#pragma once

#include "models/recording/selection.h"

namespace warmjoint::inline models {

/// The same selection without samples of velocity 0. Friction at v = 0 is whatever holds the joint,
/// not what the law gives, so that such a sample tells a fit nothing; it still warms or cools the
/// joint.
inline Selection WithoutRest(const Selection& selection, const Measurements& measurements) {
  return {selection.keep && measurements.velocity.array() != 0, selection.segments};
}

}  // namespace warmjoint::inline models
