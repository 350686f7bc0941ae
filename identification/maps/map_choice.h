// Which maps, and how strong a prior on their weights.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "identification/maps/map_fit.h"
#include "identification/model/normal_equations.h"

namespace warmjoint {

/// The criterion by which maps and the strength s of the prior are chosen.
enum class StrengthRule { cross_validation, leave_one_out, evidence };
inline std::span<const Word<StrengthRule>> WordsOf(StrengthRule) {
  static constexpr std::array words{Word{"cv", StrengthRule::cross_validation},
                                    Word{"loo", StrengthRule::leave_one_out},
                                    Word{"evidence", StrengthRule::evidence}};
  return words;
}

/// Shapes of maps to choose from.
using MapShapes = std::vector<std::vector<FrictionMap>>;

struct ChosenMaps {
  size_t candidate = 0;
  double strength = 0;
  /// Mean squared error held out, or -2 log evidence / n: the smaller, the better. Infinite where
  /// nothing can be solved.
  double criterion = 0;
  std::optional<NormalEquations> normal{};  // of these maps, where something can be solved
};

/// The best of the candidates with one of 20 strengths each, in steps of half a decade, from 1e-7 of the
/// mean diagonal of the kernels' Gram matrix on; or with the strength of the most evidence.
///
/// Cross validation takes the fewest kernels and then the strongest prior that are as good as the
/// best within one standard error of the parts' differences (Breiman and others 1984, 3.4.3). And
/// it takes only candidates and priors that leave the parameters above problem.lower, if there are any. The columns of the law
/// that the kernels can imitate are held at the law's own least squares meanwhile. Why: where a motion
/// repeats itself, so that in both directions each position has one speed, no part shows
/// the effect of a weak prior on such columns. Large weights would cancel against a
/// parameter of the wrong sign, and the fit would describe how the controller reacts to small errors of
/// the speed.
/// The candidates with the most kernels, which cost the most, are tried only where the next finest are the best of the others.
/// problem.maps is not read. candidates: at least one, by their number of kernels; folds: contiguous parts of the kept samples
/// for cross validation; with maps over the energy eight shorter ones make a fold, since a joint
/// warms up but once and one part alone has seen it cold. Neighbours resemble each other, so that
/// leaving out one sample or the evidence of white noise take coloured noise for friction: cross
/// validation over long parts does not.
ChosenMaps ChooseMaps(MapProblem problem, const MapShapes& candidates, StrengthRule rule,
                      int folds);

}  // namespace warmjoint
