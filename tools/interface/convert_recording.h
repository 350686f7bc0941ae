// Recordings of the interface and of the rooms.
#pragma once

#include <warmjoint/recording.h>

#include <optional>

#include "identification/preparation/prepared_log.h"
#include "tools/actions/recording_source.h"

namespace warmjoint::api {

models::JointKind ToKind(JointKind joint);
JointKind FromKind(models::JointKind joint);

/// The log as the rooms have it, checked as a file is. Throws models::BadInput.
models::Measurements ToMeasurements(const Recording& recording);

/// origin stays empty.
Recording FromMeasurements(const models::Measurements& measurements);

/// Throws models::BadInput for a project that is no JSON.
tools::RecordingSource ToSource(const Origin& origin);
Origin FromSource(const tools::RecordingSource& source);

/// What a prepared log of the interface holds.
struct PreparedLog::State {
  identification::PreparedLog log;
  std::vector<std::string> faults, warnings;
  std::optional<Origin> origin;
};

}  // namespace warmjoint::api
