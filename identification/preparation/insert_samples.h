// Samples put into a log between those that were taken.
#pragma once

#include <warmjoint/recording.h>

#include <vector>

namespace warmjoint {

/// A sample to be put in.
struct InsertedSample {
  Eigen::Index after = 0;  // the sample before it
  double time = 0;         // s, between that sample and the next
  double position = 0;     // rad or m
  double velocity = 0;     // rad/s or m/s, until the next sample
};

/// Puts samples in, ascending in time: with the torque and the other columns of the sample behind,
/// and not kept, so that the thermal filter alone sees them. selection: of the N samples of `log`;
/// its segments and the log's starts keep their samples.
void InsertSamples(const std::vector<InsertedSample>& inserted, Measurements& log,
                   Selection& selection);

}  // namespace warmjoint
