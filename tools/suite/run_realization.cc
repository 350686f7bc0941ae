#include "tools/suite/run_realization.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "identification/score/compensation_score.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/low_pass.h"
#include "models/foundation/robust_noise.h"
#include "models/foundation/sha256.h"
#include "models/friction/thermal.h"
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

/// Realizations from here on are the days before. why: no suite has as many.
constexpr std::uint64_t kDayBefore = std::uint64_t{1} << 40;

class Stopwatch {
 public:
  double Seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

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

/// What compensators are run on.
struct Days {
  LogSamples today, before;
  const Simulation& truth;  // of today
  Friction known;           // as a friction file has it
  Eigen::VectorXd contact;  // [N] today, N.m or N
};

/// why: a gear warms by tens of kelvins in a day of work, and a sensor on its housing is late by minutes.
constexpr double kLargestRise = 30;    // K
constexpr double kHousingLag = 300;    // s
constexpr double kReadingNoise = 0.2;  // K

/// What falls with the temperature of what rubs: its heat and what the room does. [N] N.m or N
Eigen::VectorXd WarmLevel(const Simulation& recording, const AmbientDrift& drift) {
  if (drift.amplitude == 0) return recording.truth.energy;
  return recording.truth.energy + drift.LevelAlong(recording.measurements.time);
}

/// The log with what a sensor on the housing reads, K over the cold joint. level: as WarmLevel; warm: what of it is kLargestRise.
LogSamples WithTemperature(const PreparedLog& prepared, const Eigen::VectorXd& level, double warm,
                           RandomStream random) {
  LogSamples log = prepared.raw().measurements;
  if (warm == 0 || level.size() != log.size()) return log;
  Eigen::VectorXd reading = LowPass(log.time, kLargestRise / warm * level, kHousingLag);
  for (double& one : reading) one += kReadingNoise * random.Normal();
  log.temperature = std::move(reading);
  return log;
}

/// The log of the same joint on the day before, on which nothing leaned on it.
Simulation DayBefore(Scenario scenario, std::uint64_t realization) {
  scenario.disturbances.contact = {};
  return MakePlant(scenario)->Run(kDayBefore + realization);
}

/// The friction as a file has it: one stage of heat, no surroundings, and how it grows with the load.
Friction KnownOf(Friction friction, const Disturbances& disturbances) {
  friction.second_thermal.reset();
  friction.level_per_temperature = 0;
  friction.load_gain += disturbances.load_change.gain;
  return friction;
}

/// The residual by minute, for pictures.
TraceTable ByMinute(const CompensationScore& score) {
  TraceTable table{{"minute", "residual"}, {}};
  for (Eigen::Index i = 0; i < score.by_minute.size(); ++i) {
    table.values.push_back(static_cast<float>(i));
    table.values.push_back(static_cast<float>(score.by_minute[i]));
  }
  return table;
}

Result RunCompensator(const PreparedCompensator& compensate, const Days& days) {
  Result result;
  const Stopwatch watch;
  const LogSamples& log = days.today;
  const bool sees = compensate.arm.sees == Sees::truth;
  try {
    const Eigen::VectorXd found =
        compensate.arm.along({log, days.before, days.known, compensate.arm.options,
                              sees ? &days.truth.truth.force : nullptr});
    result.seconds = watch.Seconds();
    if (!found.allFinite()) throw NoAnswer("bad_answer", "a torque is not a finite number");
    const CompensationScore score = ScoreCompensation(found, log, days.truth.truth, days.contact);
    for (const CompensationMeasure& measure : kCompensationMeasures) {
      result.measures.emplace_back(measure.name, score.*measure.value);
    }
    result.trace = ByMinute(score);
    result.status = StatusName(Status::ok);
  } catch (const NoAnswer& failure) {
    result.status = failure.status;
    result.message = failure.what();
  } catch (const std::exception& error) {
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
  std::optional<Simulation> recording, before;
  // a log that cannot be simulated is nobody's to identify: the same failure for every identifier
  try {
    recording = bench.plant->Run(realized);
    if (!contestants.compensators.empty()) before = DayBefore(bench.scenario, realized);
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
    const PreparedLog log = Prepare(recording->measurements);
    const StartKey start = StartKeyOf(bench.scenario.seed, realized);
    for (const PreparedIdentifier& identify : contestants.identifiers) {
      realization.results.push_back(RunIdentifier(identify, *recording, log, start));
    }
    if (before) {
      const Disturbances& disturbances = bench.scenario.disturbances;
      // both days by one sensor
      const Eigen::VectorXd level = WarmLevel(*recording, disturbances.ambient_drift);
      Eigen::Index warmest = 0;
      level.cwiseAbs().maxCoeff(&warmest);
      const double warm = level[warmest];
      const RandomKey key{bench.scenario.seed, realized};
      const RandomKey earlier{bench.scenario.seed, kDayBefore + realized};
      const Days days{WithTemperature(log, level, warm, {key, Stream::temperature_noise}),
                      WithTemperature(Prepare(before->measurements),
                                      WarmLevel(*before, disturbances.ambient_drift), warm,
                                      {earlier, Stream::temperature_noise}),
                      *recording, KnownOf(recording->truth.friction, disturbances),
                      disturbances.contact.TorqueAlong(recording->measurements.time)};
      for (const PreparedCompensator& compensate : contestants.compensators) {
        realization.results.push_back(RunCompensator(compensate, days));
      }
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
