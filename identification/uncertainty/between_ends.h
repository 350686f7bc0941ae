// Intervals of a value that is known up to a choice between two.
#pragma once

namespace warmjoint {

/// How many deviations an interval reaches beyond both ends of a range, so that it holds the end that is true, or what
/// lies between, with 95 %: C of
///
///     Phi(C + range) - Phi(-C) = 0.95,
///
/// 1.96 where both ends are one, down to 1.64 where they lie far apart, since the truth is then left on one side alone.
/// range: of the ends from each other, in deviations, >= 0. Source: Imbens, Manski, Confidence Intervals for Partially
/// Identified Parameters, Econometrica 72 (2004), 1845.
double ReachBeyondEnds(double range);

}  // namespace warmjoint
