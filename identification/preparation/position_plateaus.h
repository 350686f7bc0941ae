// Segments at one speed as the positions of a recording tell them, and the changes of speed between them.
#pragma once

#include <warmjoint/recording.h>

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "identification/preparation/position_noise.h"
#include "identification/preparation/speed_change.h"
#include "models/recording/measurements.h"

namespace warmjoint {

/// A segment at one speed, or a rest.
struct Plateau {
  Eigen::Index begin = 0, end = 0;  // samples
  bool moves = false;
  std::optional<PositionLine> line;
  double drift = 0;         // of the velocity, rad/s^2 or m/s^2; 0 where it does not show
  bool is_straight = true;  // its positions lie on its line
};

/// The plateaus of one recording of a log.
struct PositionPlateaus {
  Eigen::VectorXd time;      // [n] s
  Eigen::VectorXd position;  // [n] less the first, rad or m
  double longest = 0;        // between samples without a gap, s
  PositionNoise noise;
  Eigen::Array<bool, Eigen::Dynamic, 1> keep;  // [n] samples of straight lines
  std::vector<Plateau> plateaus;
  std::vector<std::optional<SpeedChange>> changes;  // behind each plateau but the last
};

/// Lines through the positions of segments and rests, and the changes of speed between them, found in turn; then each
/// segment reaches as near to a change as its positions stay on their line. selection, rests: of the whole log;
/// range: of the recording.
PositionPlateaus FindPlateaus(const Measurements& log, const Selection& selection,
                              const std::vector<Segment>& rests, SampleRange range);

}  // namespace warmjoint
