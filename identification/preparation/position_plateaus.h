// Segments at one speed by the positions of a recording, and the changes of speed between them.
#pragma once

#include <warmjoint/recording.h>

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "identification/preparation/position_noise.h"
#include "identification/preparation/select.h"
#include "identification/preparation/speed_change.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint {

/// A segment at one speed, or a rest.
struct Plateau {
  Eigen::Index begin = 0, end = 0;  // samples
  bool moves = false;
  std::optional<StraightLine> line;
  double drift = 0;         // of the velocity, rad/s^2 or m/s^2; 0 where it does not show
  bool is_straight = true;  // its positions lie on its line
};

struct PositionPlateaus {
  Eigen::VectorXd position;         // [N] less the first, rad or m
  std::vector<SampleRange> pieces;  // between gaps
  PositionNoise noise;
  SampleMask keep;  // [N] samples of straight lines
  std::vector<Plateau> plateaus;
  std::vector<std::optional<SpeedChange>> changes;  // after each plateau but the last
};

/// Lines through the positions of segments and rests, and the changes of speed between them, found in turn; then each
/// segment reaches as near to a change as its positions stay on their line.
PositionPlateaus FindPlateaus(const Measurements& log, const ConstantSpeed& found);

}  // namespace warmjoint
