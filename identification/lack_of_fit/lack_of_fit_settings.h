// How strict a verdict is, and what it takes for granted.
#pragma once

#include <warmjoint/estimate.h>

namespace warmjoint {

struct LackOfFitSettings {
  /// Change of the friction of law and heat by what was found (Harm), rms as a share of the friction's, from
  /// which a model is refused. A smaller one widens the intervals. 0 < relevance <= 1.
  double relevance = kDefaultRelevance;
  StartBelief start = StartBelief::cold;
};

}  // namespace warmjoint
