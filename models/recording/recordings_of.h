// The recordings that a log is joined of.
#pragma once

#include <vector>

#include "models/recording/measurements.h"

namespace warmjoint::inline models {

/// Samples first, ..., first + count - 1 of a log.
struct SampleRange {
  Eigen::Index first = 0, count = 0;
};

/// The samples of each recording, in order: all of them where the log is one.
inline std::vector<SampleRange> RecordingsOf(const Measurements& log) {
  std::vector<SampleRange> recordings;
  Eigen::Index first = 0;
  for (const Eigen::Index start : log.starts) {
    recordings.push_back({first, start - first});
    first = start;
  }
  recordings.push_back({first, log.size() - first});
  return recordings;
}

}  // namespace warmjoint::inline models
