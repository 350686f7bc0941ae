// How maps are sampled before a joint moves, and what that costs.
#pragma once

#include <warmjoint/friction.h>

#include <vector>

namespace warmjoint {

/// Values of one quantity at which a map is surveyed for its slope over speed and its size at rest: its centres; speeds from 0 to three widths
/// beyond the centres, four to a width and 500 at most; 0 alone, or speeds 0 and 1, where the map does not depend on it.
std::vector<double> SurveySamples(const FrictionMap& map, MapQuantity quantity);

/// Evaluations of a kernel that surveying a map takes: its samples over all quantities, each in both directions, times the
/// kernels within reach, those of the longest axis counted as one. map: its axes checked.
double SurveyWork(const FrictionMap& map);

/// The most that a friction's maps may need together; some 10 s.
inline constexpr double kMostSurveyWork = 2e9;

}  // namespace warmjoint
