// How strict a verdict is, and what it takes for granted.
#pragma once

#include <warmjoint/estimate.h>

namespace warmjoint {

/// What is known of the warmth at the start of a log.
enum class StartBelief {
  cold,     // the joint was cold: intervals hold under that condition
  unknown,  // it may have been a tenth as warm as it gets: intervals reach as far as that moves them
};

struct Judging {
  /// Change of the friction of law and heat by what was found (Harm), rms as a share of the friction's, from
  /// which a model is refused. A smaller one widens the intervals. 0 < relevance <= 1.
  double relevance = kDefaultRelevance;
  StartBelief start = StartBelief::cold;
};

}  // namespace warmjoint
