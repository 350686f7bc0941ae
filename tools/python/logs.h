// Recordings as Python holds them.
#pragma once

#include <nanobind/nanobind.h>
#include <warmjoint/prepared_log.h>
#include <warmjoint/recording.h>

#include <memory>
#include <optional>
#include <vector>

namespace warmjoint::python {

/// One recording as it was read, and what was asked of its segments: all that Prepare needs, so that a copy in another process is the
/// same to the last bit.
struct LogPart {
  Measurements read;
  PrepareSettings prepare;
};

/// Recordings that are prepared, as one log, and the files that they were read from.
struct Log {
  PreparedLog prepared;
  std::vector<std::shared_ptr<const LogPart>> parts;
  std::optional<RecordingSource> source;

  const Measurements& measurements() const { return prepared.raw().measurements; }
};

/// The class Log of a module, and the functions that make logs.
void AddLogs(nanobind::module_& module);

}  // namespace warmjoint::python
