// What the targets of binary recordings share. The libraries crash and hang on damaged files; what may not happen is that
// this process does.
#pragma once

#include <functional>

#include "models/recording/read_recording.h"
#include "tests/fuzz/fuzz.h"

namespace warmjoint::fuzz {

/// patience: s; some inputs make a library run for ever.
inline void ReadBinaryLog(std::string_view bytes, std::string_view extension, double patience) {
  const ScratchFile file(bytes, extension);
  // half of the inputs by columns of matrices in groups
  ReadSettings layout;
  if (std::hash<std::string_view>()(bytes) % 2 == 1) {
    layout.map = {{"position", "m[1]"}, {"torque", "g/m[0]"}};
  }
  const Measurements log = ReadRecordingFile(file.path().string(), layout, patience);
  const Eigen::Index n = log.size();
  Require(n >= 3 && log.position.size() == n);
  Require(log.velocity.size() == n || log.velocity.size() == 0);
  Require(log.position.allFinite() && log.velocity.allFinite() && log.torque.allFinite());
  Require((log.time.tail(n - 1).array() > log.time.head(n - 1).array()).all());
}

}  // namespace warmjoint::fuzz
