// What maps add to the level of friction, and how they are sampled before a joint moves.
#pragma once

#include <warmjoint/friction.h>
#include <warmjoint/friction_model.h>

#include <vector>

#include "models/friction/prepared_map.h"

namespace warmjoint {

/// Values of one quantity at which a map is surveyed for its slope over speed and its size at rest: its centres; speeds from 0 to three widths
/// beyond the centres, four to a width and 500 at most; 0 alone, or speeds 0 and 1, where the map does not depend on it.
std::vector<double> SurveySamples(const FrictionMap& map, MapQuantity quantity);

/// Evaluations of a kernel that surveying a map takes: its samples over all quantities, each in both directions, times the
/// kernels within reach, those of the longest axis counted as one. map: its axes checked.
double SurveyWork(const FrictionMap& map);

/// The most that a friction's maps may need together; some 10 s.
inline constexpr double kMostSurveyWork = 2e9;

/// Whether friction depends on the load that the joint transmits.
bool NeedsLoad(const Friction& friction);

/// The part of the level that maps tell:
///   side sum_i map_i(position, motor position, side |v|, E, load)
/// with the motor position mod(gear position, 2 pi). A map without a velocity axis is a force that
/// is the same in both directions, so it raises the level of one side and lowers the other's.
class LevelTerms {
 public:
  /// friction: checked.
  explicit LevelTerms(const Friction& friction);

  bool empty() const { return maps_.empty(); }

  /// side: 1 or -1; speed: |v|, rad/s or m/s. Returns N.m or N.
  double At(int side, double speed, const JointPlace& place) const;

  /// The steepest rise of the maps over speed, and their largest size at rest, both by sampling
  /// between all centres: N.m.s/rad or N.s/m, and N.m or N.
  double SteepestSlope() const { return steepest_slope_; }
  double LargestAtRest() const { return largest_at_rest_; }

 private:
  void Survey(const Friction& friction);

  double gear_ = 1;
  std::vector<PreparedMap> maps_;
  double steepest_slope_ = 0;
  double largest_at_rest_ = 0;
};

}  // namespace warmjoint
