#include "tools/design/read_motion.h"

#include <algorithm>
#include <filesystem>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/recording/read_recording.h"

namespace warmjoint {

std::optional<TimedMotion> ReadMotion(const std::string& file) {
  // files of other formats are recordings
  if (std::filesystem::path(file).extension() != ".csv") return std::nullopt;
  const FileContent content = ParseTable(ReadWholeFile(file), file);
  const auto column = [&](const char* name) {
    return std::ranges::find(content.columns, name, &FileColumn::name);
  };
  const auto time = column("time"), position = column("position"), velocity = column("velocity");
  const auto none = content.columns.end();
  if (time == none || position == none || velocity == none || column("torque") != none) {
    return std::nullopt;
  }

  // corners from time 0
  TimedMotion made;
  const Eigen::Index n = time->values.size();
  for (Eigen::Index i = 0; i < n; ++i) {
    made.motion.corners.push_back({time->values[i] - time->values[0], velocity->values[i]});
  }
  if (n < 2 || !made.motion.CornersAscend()) {
    Refuse({file}, "has {} rows; a motion has two or more, whose times ascend", n);
  }
  made.motion.start = position->values[0];
  made.duration = made.motion.corners.back().time;
  return made;
}

}  // namespace warmjoint
