// What maps add to the level of friction.
#pragma once

#include <optional>
#include <vector>

#include "models/friction/friction_description.h"
#include "models/friction/prepared_map.h"

namespace warmjoint::inline models {

/// Whether friction depends on the load that the joint transmits.
bool NeedsLoad(const FrictionDescription& friction);

/// Where a joint is, besides its direction and speed.
struct JointPlace {
  double position = 0;                     // rad or m
  double energy = 0;                       // E of all stages together, N.m or N
  double load = 0;                         // that the joint transmits, N.m or N, signed
  std::optional<double> motor_position{};  // rad; not given: the gear times the position
};

/// The part of the level that maps tell:
///   side sum_i map_i(position, motor position, side |v|, E, load)
/// with the motor position mod(gear position, 2 pi). A map without a velocity axis is a force that
/// is the same in both directions, so it raises the level of one side and lowers the other's.
class LevelTerms {
 public:
  /// friction: checked.
  explicit LevelTerms(const FrictionDescription& friction);

  bool empty() const { return maps_.empty(); }

  /// side: 1 or -1; speed: |v|, rad/s or m/s. Returns N.m or N.
  double At(int side, double speed, const JointPlace& place) const;

  /// The steepest rise of the maps over speed, and their largest size at rest, both by sampling
  /// between all centres: N.m.s/rad or N.s/m, and N.m or N.
  double SteepestSlope() const { return steepest_slope_; }
  double LargestAtRest() const { return largest_at_rest_; }

 private:
  void Survey(const FrictionDescription& friction);

  double gear_ = 1;
  std::vector<PreparedMap> maps_;
  double steepest_slope_ = 0;
  double largest_at_rest_ = 0;
};

}  // namespace warmjoint::inline models
