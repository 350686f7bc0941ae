#include <warmjoint/recording.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "identification/preparation/check_report.h"
#include "identification/preparation/prepare.h"
#include "models/recording/assemble.h"
#include "models/recording/read_recording.h"
#include "models/recording/recording_columns.h"
#include "tools/interface/convert_numbers.h"
#include "tools/interface/convert_recording.h"
#include "tools/interface/guarded.h"

namespace warmjoint::api {
namespace {

void RefuseLengths(const std::map<std::string, std::vector<double>>& columns,
                   const std::string& name) {
  // all as long as the first by name
  for (const auto& [column, values] : columns) {
    const auto& [first, others] = *columns.begin();
    if (values.size() == others.size()) continue;
    models::Refuse({name}, "{} has {} values and {} has {}; give one for each sample", column,
                   values.size(), first, others.size());
  }
}

identification::PrepareSettings ToHolds(const PrepareSettings& settings) {
  // seconds that are finite and not below 0
  const auto require = [](double seconds, const char* option) {
    if (std::isfinite(seconds) && seconds >= 0) return;
    models::Refuse({option}, "is {}; it must be a finite number of at least 0, s", seconds);
  };
  require(settings.trim, "--trim");
  require(settings.shortest_hold, "--shortest-hold");
  return {settings.trim, settings.shortest_hold};
}

/// The joined recordings as the rooms have them, prepared.
std::shared_ptr<const PreparedLog::State> Prepared(const Recording& recording,
                                                   const PrepareSettings& settings) {
  // settings are refused before any time is spent
  const identification::PrepareSettings holds = ToHolds(settings);
  identification::PreparedLog log = identification::Prepare(ToMeasurements(recording), holds);

  // what is asked for often is computed once
  const std::vector<std::string> faults = log.faults(), warnings = log.warnings();
  PreparedLog::State state{std::move(log), faults, warnings, recording.origin};
  // a fit to the same file would be prepared in the same way
  if (state.origin) state.origin->prepare = settings;
  return std::make_shared<const PreparedLog::State>(std::move(state));
}

RecordingCheck FromCheck(const identification::RecordingCheck& made) {
  RecordingCheck check;
  // how the samples lie in time
  const auto& [samples, duration, step, rate, jitter, gaps, longest] = made.sampling;
  check.sampling = {static_cast<std::size_t>(samples), duration, step, rate, jitter, gaps, longest};

  // how the joint moves
  const identification::MotionCheck& motion = made.motion;
  check.motion.constant_share = motion.constant_share;
  check.motion.rest_share = motion.rest_share;
  check.motion.segments = motion.segments;
  for (const identification::SpeedLevel& level : motion.levels) {
    check.motion.levels.push_back(
        {level.velocity, level.segments, static_cast<std::size_t>(level.samples)});
  }
  check.motion.lower = motion.lower;
  check.motion.upper = motion.upper;
  check.motion.speed_noise = motion.speed_noise;
  check.motion.speed_resolution = motion.speed_resolution;

  // what contradicts itself, and what can be identified
  check.faults = made.faults;
  for (const identification::Excitation& one : made.excitation) {
    check.excitation.push_back({one.what, one.sufficient, one.reason});
  }

  // the same as the command line prints it
  check.text = identification::CheckToText(made);
  check.json = identification::CheckToJson(made).dump(2) + "\n";
  return check;
}

}  // namespace

std::string Version() { return WARMJOINT_VERSION; }

Recording ReadRecording(const std::filesystem::path& file, const ReadSettings& settings) {
  return ReadRecordings({file}, settings);
}

Recording ReadRecordings(const std::vector<std::filesystem::path>& files,
                         const ReadSettings& settings) {
  return Guarded([&] {
    // read as files of that name and settings on the command line
    Origin origin;
    for (const std::filesystem::path& file : files) origin.files.push_back(file.string());
    origin.read = settings;
    Recording recording = FromMeasurements(tools::ReadRecording(ToSource(origin)));
    recording.origin = std::move(origin);
    return recording;
  });
}

Recording MakeRecording(const std::map<std::string, std::vector<double>>& columns,
                        const ReadSettings& settings, const std::string& name) {
  return Guarded([&] {
    // named columns go through the layout of a file
    RefuseLengths(columns, name);
    std::vector<std::string> names;
    for (const auto& [column, values] : columns) names.push_back(column);
    const models::ReadSettings layout = ToSource({{}, settings, {}}).read;
    const auto sources = models::FindColumns(names, layout, {name});

    // and become SI as those of a file do
    models::RawColumns raw{name, {}, {}};
    for (const models::ColumnSource& source : sources) {
      raw.values.push_back(ToEigen(columns.at(names[source.index])));
    }
    return FromMeasurements(models::AssembleMeasurements(std::move(raw), sources, layout));
  });
}

void WriteRecording(const Recording& recording, const std::filesystem::path& file) {
  Guarded([&] { models::WriteRecording(ToMeasurements(recording), file); });
}

PreparedLog::PreparedLog(const Recording& recording, const PrepareSettings& settings)
    : state_(Guarded([&] { return Prepared(recording, settings); })) {}

std::vector<Segment> PreparedLog::segments() const {
  const auto& [log, selection] = state_->log.steady();
  // segments with the recording that they lie in, from 1
  std::vector<Segment> segments;
  for (const models::Segment& one : selection.segments) {
    const auto later = std::ranges::upper_bound(log.starts, one.begin);
    const auto kept = selection.keep.segment(one.begin, one.end - one.begin).count();
    segments.push_back({1 + static_cast<int>(later - log.starts.begin()), log.time[one.begin],
                        log.time[one.end - 1], one.velocity, static_cast<std::size_t>(kept)});
  }
  return segments;
}

const std::vector<std::string>& PreparedLog::faults() const { return state_->faults; }

const std::vector<std::string>& PreparedLog::warnings() const { return state_->warnings; }

JointKind PreparedLog::joint() const { return FromKind(state_->log.taken().measurements.joint); }

RecordingCheck Check(const PreparedLog& log) {
  return Guarded([&] { return FromCheck(identification::CheckRecording(log.state().log)); });
}

}  // namespace warmjoint::api
