// Samples sorted by how fast the joint moved.
#pragma once

#include <string>
#include <vector>

#include "tools/figures/figure.h"
#include "tools/figures/fit_view.h"

namespace warmjoint::figures {

/// Kept samples of like speed.
struct SpeedGroup {
  double fastest = 0;  // rad/s or m/s, > 0
  Hue hue = Hue::blue;
  std::string label;                  // "0.3 rad/s", or "0.3 … 0.6 rad/s"
  std::vector<Eigen::Index> samples;  // of the recording, in order of time
};

/// The kept samples of one direction (1 or -1) by the mean speed of their segments, slow to fast: a
/// group for each speed (within 5 %) where the whole recording has up to six, else three of about
/// equal numbers of samples, whose edges part no speed. Speeds of less than 2 % of the samples join
/// their neighbour. Groups of both directions agree; they may be empty.
std::vector<SpeedGroup> GroupBySpeed(const FitView& view, int direction);

}  // namespace warmjoint::figures
