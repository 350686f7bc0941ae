// What a joint does before it slides.
#pragma once

namespace warmjoint::inline models {

/// How friction acts on a joint that is held.
///   elastoplastic: a spring that yields at the level of sliding (bristle.h)
///   breakaway:     the same, but held it bears up to a static level above that of sliding, Eq. (4)
///   bristle:       a spring with given stiffness and damping that relaxes with travel
///                  (lugre_bristle.h)
enum class PreSliding { elastoplastic, breakaway, bristle };

}  // namespace warmjoint::inline models
