// Recordings of a run as files.
#pragma once

#include <filesystem>

#include "sim/truth/simulated_recording.h"
#include "tools/store/result.h"

namespace warmjoint::inline tools {

/// Keeps recordings in a folder, or nowhere.
class RecordingKeeper {
 public:
  /// folder: made when it is needed; empty: nothing is kept.
  explicit RecordingKeeper(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Writes variant-V/realization-R.h5 and beside it realization-R.truth.json.
  void Keep(const Recording& recording, Unit unit) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace warmjoint::inline tools
