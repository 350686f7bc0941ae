#include "tools/suite/run_realization.h"

#include <fmt/format.h>
#include <warmjoint/prepared_log.h>
#include <warmjoint/simulation.h>

#include <chrono>
#include <cmath>
#include <optional>

#include "models/foundation/output_failed.h"
#include "models/foundation/robust_noise.h"
#include "models/recording/read_recording.h"
#include "tools/suite/start_key.h"
#include "tools/suite/trace_table.h"

namespace warmjoint {
namespace {

class Stopwatch {
 public:
  double Seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Name of the first parameter that is no number, or nullptr.
const std::string* NotFinite(const Estimate& estimate) {
  for (const EstimatedParameter& parameter : estimate.parameters) {
    if (!std::isfinite(parameter.value)) return &parameter.name;
  }
  return nullptr;
}

void Fill(Result& result, const Estimate& estimate, const Simulation& recording,
          const LogView& view) {
  result.status = StatusName(estimate.status);
  result.message = estimate.FullMessage();
  // infinite or unknown numbers are no answer
  if (const std::string* name = NotFinite(estimate)) {
    throw NoAnswer("bad_answer", *name + " is not a finite number");
  }

  // no numbers, nothing to score
  result.metrics = estimate.metrics;
  if (estimate.parameters.empty()) return;
  result.score = ScoreEstimate(estimate, view.measurements, view.selection, recording.truth);
  result.trace =
      MakeTraceTable(estimate.trace, *result.score, MedianStep(recording.measurements.time));
}

Result RunIdentifier(const PreparedIdentifier& identify, const Simulation& recording,
                     const PreparedLog& log, StartKey start) {
  Result result;
  const Stopwatch watch;
  // whatever an identifier does wrong is its result
  try {
    const Estimate estimate = identify(log, start);
    result.seconds = watch.Seconds();
    Fill(result, estimate, recording, ScoredView(estimate, log));
  } catch (const NoAnswer& failure) {
    result.seconds = watch.Seconds();
    result.status = failure.status;
    result.message = failure.what();
  } catch (const OutputFailed&) {
    throw;  // no fault of the identifier's
  } catch (const std::exception& error) {
    result.seconds = watch.Seconds();
    result.status = "crashed";
    result.message = error.what();
  }
  return result;
}

/// The same failure for every identifier: there was nothing to identify.
std::vector<Result> AllFailed(size_t identifiers, const std::string& message) {
  Result result;
  result.status = "not_simulated";
  result.message = message;
  return std::vector<Result>(identifiers, result);
}

}  // namespace

void RecordingKeeper::Keep(const Simulation& recording, RunUnit unit) const {
  if (folder_.empty()) return;
  const std::filesystem::path folder = folder_ / fmt::format("variant-{}", unit.variant);
  std::filesystem::create_directories(folder);
  const std::string stem = folder / fmt::format("realization-{}", unit.realization);
  WriteRecording(recording.measurements, stem + ".h5");
  WriteTruth(recording.truth, stem + ".truth.json");
}

Bench MakeBench(const Scenario& scenario) { return {scenario, MakePlant(scenario)}; }

RealizationResult RunRealization(const Bench& bench,
                                 const std::vector<PreparedIdentifier>& identifiers, RunUnit unit,
                                 const RecordingKeeper& keeper) {
  const auto realized = static_cast<std::uint64_t>(unit.realization);
  RealizationResult done;
  Realization& realization = done.realization;
  realization.unit = unit;
  const Stopwatch watch;
  std::optional<Simulation> recording;
  // a log that cannot be simulated is nobody's to identify
  try {
    recording = bench.plant->Run(realized);
  } catch (const std::exception& error) {
    realization.results = AllFailed(identifiers.size(), error.what());
  }
  realization.simulation_seconds = watch.Seconds();

  if (recording) {
    done.following = recording->following;
    // all identifiers see the same log, and draw starts from the same key
    const PreparedLog log = Prepare(recording->measurements);
    const StartKey start = StartKeyOf(bench.scenario.seed, realized);
    for (const PreparedIdentifier& identify : identifiers) {
      realization.results.push_back(RunIdentifier(identify, *recording, log, start));
    }
    // the truth is on disk only once the answers are in
    keeper.Keep(*recording, unit);
  }

  // where each result belongs in the run
  for (size_t i = 0; i < realization.results.size(); ++i) {
    realization.results[i].variant = unit.variant;
    realization.results[i].realization = unit.realization;
    realization.results[i].identifier = static_cast<int>(i);
  }
  return done;
}

}  // namespace warmjoint
