#include "tools/suite/run_compensator.h"

#include <cmath>

#include "identification/preparation/velocity_scale.h"
#include "identification/score/compensation_score.h"
#include "models/foundation/low_pass.h"
#include "models/foundation/random_stream.h"
#include "sim/plant/plant.h"
#include "tools/suite/stopwatch.h"

namespace warmjoint {
namespace {

using Eigen::VectorXd;

/// Realizations from here on are the days before. why: no suite has as many.
constexpr std::uint64_t kDayBefore = std::uint64_t{1} << 40;

/// why: a gear warms by tens of kelvins in a day of work, and a sensor on its housing is late by minutes.
constexpr double kLargestRise = 30;    // K
constexpr double kHousingLag = 300;    // s
constexpr double kReadingNoise = 0.2;  // K

/// What falls with the temperature of what rubs: its heat and what the room does. [N] N.m or N
VectorXd WarmLevel(const Simulation& recording, const Disturbances& room) {
  const double per_kelvin = recording.truth.friction.level_per_temperature;
  const VectorXd& time = recording.measurements.time;
  VectorXd level = recording.truth.energy + room.ambient_drift.LevelAlong(time);
  level +=
      time.unaryExpr([&](double t) { return per_kelvin * room.ambient_temperature.RiseAt(t); });
  return level;
}

/// The log as a controller has it. why: a description takes off weight and inertia, and a held joint creeps while its drive and its
/// friction share the load, which tells nothing of the friction that slides.
LogSamples AsControlled(const PreparedLog& prepared, const VectorXd& rigid) {
  LogSamples log = prepared.raw().measurements;
  if (rigid.size() == log.size()) log.torque -= rigid;
  const double rest = MeasureVelocity(log).Rest();
  log.velocity = (log.velocity.array().abs() <= rest).select(0, log.velocity).eval();
  return log;
}

/// Adds what a sensor on the housing reads. level: as WarmLevel; warm: what of it is kLargestRise.
void AddTemperature(const VectorXd& level, double warm, RandomStream random, LogSamples& log) {
  if (warm == 0 || level.size() != log.size()) return;
  VectorXd reading = LowPass(log.time, kLargestRise / warm * level, kHousingLag);
  for (double& one : reading) one += kReadingNoise * random.Normal();
  log.temperature = std::move(reading);
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

}  // namespace

CompensationDays MakeDays(const Scenario& scenario, std::uint64_t realization,
                          const Simulation& recording, const PreparedLog& log) {
  Scenario free = scenario;
  free.disturbances.contact = {};
  const Simulation earlier = MakePlant(free)->Run(kDayBefore + realization);
  const Disturbances& disturbances = scenario.disturbances;
  CompensationDays days{AsControlled(log, recording.rigid),
                        AsControlled(Prepare(earlier.measurements), earlier.rigid), recording,
                        KnownOf(recording.truth.friction, disturbances),
                        disturbances.contact.TorqueAlong(recording.measurements.time)};

  // both days by one sensor
  const VectorXd level = WarmLevel(recording, disturbances);
  Eigen::Index warmest = 0;
  level.cwiseAbs().maxCoeff(&warmest);
  const auto sensor = [&](std::uint64_t day) {
    return RandomStream({scenario.seed, day}, Stream::temperature_noise);
  };
  AddTemperature(level, level[warmest], sensor(realization), days.today);
  AddTemperature(WarmLevel(earlier, disturbances), level[warmest], sensor(kDayBefore + realization),
                 days.before);
  return days;
}

Result RunCompensator(const PreparedCompensator& compensate, const CompensationDays& days) {
  Result result;
  const Stopwatch watch;
  const LogSamples& log = days.today;
  const Truth& truth = days.recording.truth;
  const bool sees = compensate.arm.sees == Sees::truth;
  try {
    const VectorXd found = compensate.arm.along(
        {log, days.before, days.known, compensate.arm.options, sees ? &truth.force : nullptr});
    result.seconds = watch.Seconds();
    if (!found.allFinite()) throw NoAnswer("bad_answer", "a torque is not a finite number");
    const CompensationScore score = ScoreCompensation(found, log, truth, days.contact);
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

}  // namespace warmjoint
