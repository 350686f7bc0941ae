#include "tools/suite/run_realization.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "models/foundation/bad_input.h"
#include "models/foundation/robust_noise.h"
#include "models/foundation/sha256.h"
#include "models/friction/thermal.h"
#include "tools/suite/run_compensator.h"
#include "tools/suite/stopwatch.h"
#include "tools/terminal/shell_words.h"

namespace warmjoint {
namespace {

using Values = std::map<std::string, double>;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// The entry's parameters, with both thermal pairs where it has one.
Values AllParameters(const TraceEntry& entry, double step) {
  Values values(entry.parameters.begin(), entry.parameters.end());
  const std::string gain(kGainName), tau(kTimeConstantName), discrete_gain(kDiscreteGainName),
      pole(kPoleName);
  // each pair of the warming follows from the other and the step
  const bool continuous = values.count(gain) && values.count(tau);
  const bool discrete = values.count(discrete_gain) && values.count(pole);
  if (continuous && !discrete) {
    const DiscreteThermal pair = Discretise({values[gain], values[tau]}, step);
    values[discrete_gain] = pair.gain;
    values[pole] = pair.pole;
  }
  if (discrete && !continuous) {
    const Thermal pair = Continuous({values[discrete_gain], values[pole]}, step);
    values[gain] = pair.gain;
    values[tau] = pair.time_constant;
  }
  return values;
}

/// NPE of values over the parameters of `scores`, whose estimates are written over; one that is missing counts as 0, one
/// whose truth is 0 not.
double Npe(std::vector<ParameterScore>& scores, const Values& values) {
  for (ParameterScore& score : scores) {
    const auto found = values.find(score.name);
    score.estimate = found == values.end() ? 0.0 : found->second;
  }
  return ParameterError(scores);
}

void Fill(Result& result, const Estimate& estimate, const Simulation& recording,
          const LogView& view) {
  result.status = StatusName(estimate.status);
  result.message = estimate.FullMessage();
  // infinite or unknown numbers are no answer
  for (const EstimatedParameter& parameter : estimate.parameters) {
    if (std::isfinite(parameter.value)) continue;
    throw NoAnswer("bad_answer", parameter.name + " is not a finite number");
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

/// Writes variant-V/realization-R.h5 and beside it realization-R.truth.json.
void KeepRecording(const Simulation& recording, RunUnit unit,
                   const std::filesystem::path& recordings) {
  const std::filesystem::path folder = recordings / fmt::format("variant-{}", unit.variant);
  std::filesystem::create_directories(folder);
  const std::string stem = folder / fmt::format("realization-{}", unit.realization);
  WriteRecording(recording.measurements, stem + ".h5");
  WriteTruth(recording.truth, stem + ".truth.json");
}

}  // namespace

StartKey StartKeyOf(std::uint64_t seed, std::uint64_t realization) {
  const std::string digits =
      Sha256(fmt::format("warmjoint identifier start {} {}", seed, realization));
  StartKey key;
  for (size_t i = 0; i < key.digest.size(); ++i) {
    key.digest[i] = std::stoull(digits.substr(16 * i, 16), nullptr, 16);
  }
  return key;
}

TraceTable MakeTraceTable(const std::vector<TraceEntry>& trace, const Score& score, double step) {
  TraceTable table;
  if (trace.empty()) return table;

  // the parameters of the first iteration are those of all
  table.columns = {"iteration", "rmse", "npe_continuous", "npe_discrete"};
  for (const auto& [name, value] : trace.front().parameters) table.columns.push_back(name);
  // a row for each iteration, with its errors against the truth
  std::vector<ParameterScore> continuous = score.continuous, discrete = score.discrete;
  for (const TraceEntry& entry : trace) {
    const Values values = AllParameters(entry, step);
    std::vector<double> row{static_cast<double>(entry.iteration), entry.rmse,
                            Npe(continuous, values), Npe(discrete, values)};
    // the parameters that this iteration has
    for (size_t i = row.size(); i < table.columns.size(); ++i) {
      const auto found = values.find(table.columns[i]);
      row.push_back(found == values.end() ? kUnknown : found->second);
    }
    for (const double value : row) table.values.push_back(static_cast<float>(value));
  }
  return table;
}

Bench MakeBench(const Scenario& scenario) { return {scenario, MakePlant(scenario)}; }

RealizationResult RunRealization(const Bench& bench, const Contestants& contestants, RunUnit unit,
                                 const std::filesystem::path& recordings) {
  const auto realized = static_cast<std::uint64_t>(unit.realization);
  RealizationResult done;
  Realization& realization = done.realization;
  realization.unit = unit;
  const Stopwatch watch;
  std::optional<Simulation> recording;
  std::optional<PreparedLog> log;
  std::optional<CompensationDays> days;
  // a log that cannot be simulated is nobody's to identify: the same failure for every identifier
  try {
    recording = bench.plant->Run(realized);
    log = Prepare(recording->measurements);
    if (!contestants.compensators.empty()) {
      days.emplace(MakeDays(bench.scenario, realized, *recording, *log));
    }
  } catch (const std::exception& error) {
    recording.reset();
    Result failed;
    failed.status = "not_simulated";
    failed.message = error.what();
    realization.results.assign(contestants.size(), failed);
  }
  realization.simulation_seconds = watch.Seconds();

  if (recording) {
    done.following = recording->following;
    // all identifiers see the same log, and draw starts from the same key
    const StartKey start = StartKeyOf(bench.scenario.seed, realized);
    for (const PreparedIdentifier& identify : contestants.identifiers) {
      realization.results.push_back(RunIdentifier(identify, *recording, *log, start));
    }
    for (const PreparedCompensator& compensate : contestants.compensators) {
      realization.results.push_back(RunCompensator(compensate, *days));
    }
    // the truth is on disk only once the answers are in
    if (!recordings.empty()) KeepRecording(*recording, unit, recordings);
  }

  // where each result belongs in the run
  for (size_t i = 0; i < realization.results.size(); ++i) {
    realization.results[i].variant = unit.variant;
    realization.results[i].realization = unit.realization;
    realization.results[i].identifier = static_cast<int>(i);
  }
  return done;
}

Replayed ReplayUnit(const Suite& suite, RunUnit unit, const SuiteIdentifier& identifier) {
  if (identifier.name == kExternal) {
    Refuse({identifier.label}, "is a command from outside; a replay runs none");
  }
  const Scenario scenario = VariantScenario(suite, unit.variant);
  const auto realization = static_cast<std::uint64_t>(unit.realization);
  PreparedLog log = Prepare(MakePlant(scenario)->Run(realization).measurements);
  const auto identify = PrepareIdentifiers({identifier}, {suite.name});
  Estimate estimate = identify.front()(log, StartKeyOf(scenario.seed, realization));
  return {std::move(log), std::move(estimate)};
}

std::string NameOf(const Suite& suite, RunUnit unit) {
  std::string name = fmt::format("realization {}", unit.realization);
  if (!suite.ladder) return name;
  const auto& variants = suite.ladder->variants;
  return fmt::format("{} of {}", name, variants.at(static_cast<std::size_t>(unit.variant)).name);
}

std::string ReplayCommand(const Suite& suite, RunUnit unit, const std::string& run) {
  std::vector<std::string> words{"warmjoint", "simulate", "--from", run};
  if (suite.ladder) {
    const auto& variants = suite.ladder->variants;
    words.insert(words.end(),
                 {"--variant", variants.at(static_cast<std::size_t>(unit.variant)).name});
  }
  words.insert(words.end(), {"--realization", fmt::format("{}", unit.realization), "-o", "replay"});
  return JoinCommand(words);
}

}  // namespace warmjoint
