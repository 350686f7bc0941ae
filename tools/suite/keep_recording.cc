#include "tools/suite/keep_recording.h"

#include <fmt/format.h>

#include <string>

#include "models/recording/read_recording.h"
#include "sim/truth/truth_json.h"

namespace warmjoint::inline tools {

void RecordingKeeper::Keep(const Recording& recording, Unit unit) const {
  if (folder_.empty()) return;
  const std::filesystem::path folder = folder_ / fmt::format("variant-{}", unit.variant);
  std::filesystem::create_directories(folder);
  const std::string stem = folder / fmt::format("realization-{}", unit.realization);
  WriteRecording(recording.measurements, stem + ".h5");
  WriteTruth(recording.truth, stem + ".truth.json");
}

}  // namespace warmjoint::inline tools
