// What the targets of recordings share. The libraries of binary ones crash and hang on damaged files; what may not happen is
// that this process does.
#pragma once

#include <functional>

#include "models/recording/read_recording.h"
#include "tests/fuzz/fuzz.h"

namespace warmjoint::fuzz {

/// What every reader promises of a log that it takes.
inline void RequireSoundness(const Measurements& log) {
  const Eigen::Index n = log.size();
  Require(n >= 3 && log.position.size() == n);
  Require(log.velocity.size() == n || log.velocity.size() == 0);
  Require(log.position.allFinite() && log.velocity.allFinite() && log.torque.allFinite());
  Require((log.time.tail(n - 1).array() > log.time.head(n - 1).array()).all());
}

/// patience: s; some inputs make a library run for ever.
inline void ReadBinaryLog(std::string_view bytes, std::string_view extension, double patience) {
  const ScratchFile file(bytes, extension);
  // half of the inputs by columns of matrices in groups
  ReadSettings layout;
  if (std::hash<std::string_view>()(bytes) % 2 == 1) {
    layout.map = {{"position", "m[1]"}, {"torque", "g/m[0]"}};
  }
  RequireSoundness(ReadRecordingFile(file.path().string(), layout, patience));
}

}  // namespace warmjoint::fuzz
