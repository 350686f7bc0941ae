#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "models/foundation/low_pass.h"
#include "models/foundation/serialize.h"
#include "models/friction/sign.h"
#include "models/recording/measurements.h"
#include "sim/plant/plant.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// What happened since the last change of direction.
class Direction {
 public:
  /// To the next sample. distance: travelled since the last one, rad or m.
  void Go(double velocity, double distance) {
    const double sign = Sign(velocity);
    distance_ += std::abs(distance);
    // the first motion is no change of direction
    if (sign == 0 || sign == held_) return;
    odd_ = held_ != 0 && !odd_;
    distance_ = 0;
    held_ = sign;
  }
  bool odd() const { return odd_; }              // every other hold
  double distance() const { return distance_; }  // rad or m

 private:
  double held_ = 0;  // sign of the last motion
  double distance_ = 0;
  bool odd_ = false;
};

/// Changes of the level that follow time, direction and distance, against the motion.
VectorXd Levels(const Disturbances& d, const VectorXd& time, const VectorXd& velocity,
                const VectorXd& position) {
  const Backlash& backlash = d.hidden.backlash;
  const Hysteresis& hysteresis = d.hidden.hysteresis;
  VectorXd levels(time.size());
  Direction direction;
  for (Index i = 0; i < time.size(); ++i) {
    direction.Go(velocity[i], i > 0 ? position[i] - position[i - 1] : 0);
    // of every other hold, then with time, then with the distance since the joint turned
    double level = direction.odd() ? d.hold_parity.level : 0;
    if (time[i] >= d.step_in_time.time) level += d.step_in_time.level;
    level += d.run_in.level * std::exp(-time[i] / d.run_in.time_constant);
    if (direction.distance() < backlash.way) level -= backlash.level;
    level -= hysteresis.level * std::exp(-direction.distance() / hysteresis.way);
    levels[i] = level;
  }
  return levels;
}

/// dv/dt between neighbouring samples, as both see it. [N]
VectorXd Acceleration(const VectorXd& time, const VectorXd& velocity) {
  VectorXd acceleration = VectorXd::Zero(time.size());
  for (Index i = 1; i + 1 < time.size(); ++i) {
    acceleration[i] = (velocity[i + 1] - velocity[i - 1]) / (time[i + 1] - time[i - 1]);
  }
  return acceleration;
}

constexpr double kHour = 3600;  // s

/// The values of some samples ago; the first one before there are any.
VectorXd Delayed(const VectorXd& values, double samples) {
  const auto late = static_cast<Index>(std::min(samples, static_cast<double>(values.size())));
  VectorXd delayed = VectorXd::Constant(values.size(), values.size() > 0 ? values[0] : 0);
  delayed.tail(values.size() - late) = values.head(values.size() - late);
  return delayed;
}

/// Keeps a value for a while.
void Stick(const TimeSpan& stuck, const VectorXd& time, VectorXd& column) {
  if (stuck.duration == 0 || column.size() == 0) return;
  double held = column[0];
  for (Index i = 0; i < column.size(); ++i) {
    const bool sticks = time[i] >= stuck.time && time[i] < stuck.time + stuck.duration;
    if (sticks) column[i] = held;
    held = column[i];
  }
}

double BeyondBand(double torque, double band) {
  return std::copysign(std::max(std::abs(torque) - band, 0.0), torque);
}

/// The torque as its sensor, its range and its way to the log leave it.
void SpoilTorque(const SensorFaults& faults, const VectorXd& time, VectorXd& torque) {
  for (Index i = 0; i < torque.size(); ++i) {
    // drift, range and resolution, in the order in which they arise
    const double hours = time[i] / kHour;
    torque[i] =
        torque[i] * (1 + faults.sensor_drift.gain * hours) + faults.sensor_drift.offset * hours;
    if (time[i] >= faults.gain_step.time) torque[i] *= faults.gain_step.factor;
    if (faults.dead_band.level > 0) torque[i] = BeyondBand(torque[i], faults.dead_band.level);
    const double limit = faults.clipped.level;
    if (limit > 0) torque[i] = std::clamp(torque[i], -limit, limit);
    const double step = faults.torque_resolution.resolution;
    if (step > 0) torque[i] = step * std::round(torque[i] / step);
  }

  // and its way into the log
  if (faults.late_torque.samples > 0) torque = Delayed(torque, faults.late_torque.samples);
}

/// Leaves the samples `left` of a recording and its truth.
void Leave(const std::vector<Index>& left, Simulation& recording) {
  const auto keep = [&](VectorXd& column) {
    if (column.size() > 0) column = column(left).eval();
  };
  ForEachColumn(recording.measurements, keep);
  Truth& truth = recording.truth;
  for (VectorXd* column :
       {&truth.velocity, &truth.force, &truth.loss, &truth.energy, &recording.rigid}) {
    keep(*column);
  }
}

/// Leaves out the samples from `begin` to before `end`, s.
void LeaveOut(double begin, double end, Simulation& recording) {
  const VectorXd& time = recording.measurements.time;
  std::vector<Index> left;
  for (Index i = 0; i < time.size(); ++i) {
    if (time[i] < begin || time[i] >= end) left.push_back(i);
  }
  Leave(left, recording);
}

/// Columns that hold something else than their names say.
void MistakeColumns(const SensorFaults& faults, Measurements& log) {
  if (faults.unsigned_torque) log.torque = log.torque.cwiseAbs().eval();
  if (faults.reversed_torque) log.torque.reverseInPlace();
  if (faults.swapped_columns && log.velocity.size() > 0) log.torque.swap(log.velocity);
  if (faults.without_load) log.load.reset();
}

/// Stamps of another clock. Offsets of a golden-ratio sequence are spread evenly and agree with nothing else.
void SpoilClock(const Clock& clock, VectorXd& time) {
  double turn = 0;
  for (double& t : time) {
    t = clock.factor * t + clock.jitter * (turn - 0.5);
    turn = std::fmod(turn + std::numbers::phi - 1, 1.0);
  }
}

void AddColouredNoise(const ColouredNoise& noise, double rate, RandomStream random,
                      Simulation& recording) {
  if (noise.deviation == 0) return;
  // an AR(1) process that begins settled: its deviation is the same at each sample
  const double memory = std::exp(-1 / (rate * noise.correlation_time));
  const double fresh =
      noise.deviation * std::sqrt(-std::expm1(-2 / (rate * noise.correlation_time)));
  double value = noise.deviation * random.Normal();
  for (double& torque : recording.measurements.torque) {
    torque += value;
    value = memory * value + fresh * random.Normal();
  }

  // the truth knows both parts of the noise
  recording.truth.torque_noise = std::hypot(recording.truth.torque_noise, noise.deviation);
  recording.truth.coloured_noise = noise.deviation;
  recording.truth.correlation_time = noise.correlation_time;
}

void AddUnevenNoise(const UnevenNoise& noise, RandomStream random, Simulation& recording) {
  if (noise.of_torque == 0 && noise.of_speed == 0) return;
  const Truth& truth = recording.truth;
  // a deviation of each sample, with friction and speed
  const Eigen::VectorXd deviation =
      noise.of_torque * truth.force.cwiseAbs() + noise.of_speed * truth.velocity.cwiseAbs();
  for (Eigen::Index i = 0; i < deviation.size(); ++i) {
    recording.measurements.torque[i] += deviation[i] * random.Normal();
  }
}

void AddPeriodicTorque(const PeriodicTorque& periodic, RandomStream random, Measurements& log) {
  if (periodic.amplitude == 0) return;
  // where its period begins is drawn
  const double phase = 2 * std::numbers::pi * random.Uniform();
  log.torque.array() += periodic.amplitude *
                        (2 * std::numbers::pi / periodic.period * log.time.array() + phase).sin();
}

void AddOutliers(const Outliers& outliers, RandomStream random, Measurements& log) {
  if (outliers.fraction == 0) return;
  for (double& torque : log.torque) {
    if (random.Uniform() >= outliers.fraction) continue;
    const double off = outliers.size * random.Normal();
    torque += outliers.one_sided > 0 ? std::abs(off) : off;
  }
}

/// What hold_parity, step_in_time, run_in, contact and HiddenForces add to the torque along the true motion, [N] N.m or N. They do
/// not warm the joint.
VectorXd HiddenTorque(const Disturbances& disturbances, const VectorXd& time,
                      const VectorXd& velocity, const VectorXd& position,
                      const VectorXd& acceleration) {
  const HiddenForces& hidden = disturbances.hidden;
  // along the direction of motion
  VectorXd levels = Levels(disturbances, time, velocity, position);
  if (hidden.memory.slope != 0) {
    // the speed that it remembers, less that of now
    const VectorXd speed = velocity.cwiseAbs();
    levels += hidden.memory.slope * (LowPass(time, speed, hidden.memory.time_constant) - speed);
  }
  levels.array() += hidden.quadratic_drag.coefficient * velocity.array().square();
  if (hidden.ripple.amplitude != 0) {
    const double wave = 2 * std::numbers::pi / hidden.ripple.period;
    levels.array() += hidden.ripple.amplitude * (wave * position.array()).sin();
  }

  // what acts whatever the direction
  VectorXd torque = velocity.unaryExpr(&Sign<double>).cast<double>().cwiseProduct(levels);
  torque += hidden.spring.stiffness * position;
  if (const Contact& contact = disturbances.contact; contact.torque != 0) {
    torque += contact.TorqueAlong(time);
  }
  if (hidden.inertia.inertia != 0) {
    const bool known = acceleration.size() > 0;
    torque += hidden.inertia.inertia * (known ? acceleration : Acceleration(time, velocity));
  }
  return torque;
}

/// The motion as poorer sensors log it: filtered, stale, coarse or missing (velocity_filter, stale_position, encoder,
/// without_velocity).
void DisturbMotion(const Disturbances& disturbances, Measurements& log) {
  // the motion as filter, delay and encoder leave it
  if (disturbances.velocity_filter.time_constant > 0) {
    log.velocity = LowPass(log.time, log.velocity, disturbances.velocity_filter.time_constant);
  }
  if (const double late = disturbances.stale_position.samples; late > 0) {
    log.position = Delayed(log.position, late);
  }
  if (const double step = disturbances.encoder.resolution; step > 0) {
    log.position = step * (log.position / step).array().round();
  }
  if (disturbances.without_velocity) log.velocity.resize(0);
}

/// Leaves out single samples by chance, and their truth.
void LoseSamples(const LostSamples& lost, RandomStream random, Simulation& recording) {
  // the first and the last sample stay, so that the log keeps its length in time
  if (lost.fraction == 0) return;
  const Index last = recording.measurements.size() - 1;
  std::vector<Index> left;
  for (Index i = 0; i <= last; ++i) {
    const bool is_lost = random.Uniform() < lost.fraction;
    if (!is_lost || i == 0 || i == last) left.push_back(i);
  }
  Leave(left, recording);
}

/// Faults of SensorFaults, in the order in which they arise: drift and factors of the torque, columns that stick, limits,
/// late samples; then scales; then what the file leaves out and how its clock runs.
void SpoilLog(const SensorFaults& faults, Simulation& recording) {
  // what is at its default is not written
  if (WriteFields(faults).empty()) return;
  Measurements& log = recording.measurements;
  // each sensor by itself
  SpoilTorque(faults, log.time, log.torque);
  Stick(faults.stuck_torque, log.time, log.torque);
  Stick(faults.stuck_position, log.time, log.position);
  Stick(faults.stuck_velocity, log.time, log.velocity);
  log.position *= faults.column_scale.position;
  log.velocity *= faults.column_scale.velocity;
  log.torque *= faults.column_scale.torque;

  // the log as a whole: its columns, its samples, its clock
  MistakeColumns(faults, log);
  LeaveOut(0, faults.cut_start.time, recording);
  LeaveOut(faults.gap.time, faults.gap.time + faults.gap.duration, recording);
  if (faults.restarted_clock && log.size() > 0) log.time.array() -= log.time[0];
  SpoilClock(faults.clock, log.time);
}

}  // namespace

void DisturbLog(const Scenario& scenario, std::uint64_t realization, Simulation& recording,
                const Eigen::VectorXd& position, const Eigen::VectorXd& acceleration) {
  const RandomKey key{scenario.seed, realization};
  const Disturbances& disturbances = scenario.disturbances;
  // what the torque has beside friction: its lag and hidden forces
  Measurements& log = recording.measurements;
  if (const double lag = disturbances.torque_lag.time_constant; lag > 0) {
    log.torque += LowPass(log.time, recording.truth.force, lag) - recording.truth.force;
  }
  log.torque +=
      HiddenTorque(disturbances, log.time, recording.truth.velocity, position, acceleration);

  // what sensors make of the motion, then noise on the torque
  DisturbMotion(disturbances, log);
  AddColouredNoise(disturbances.coloured_noise, scenario.sampling.rate,
                   {key, Stream::coloured_noise}, recording);
  AddUnevenNoise(disturbances.uneven_noise, {key, Stream::uneven_noise}, recording);
  AddPeriodicTorque(disturbances.periodic_torque, {key, Stream::periodic_torque},
                    recording.measurements);
  AddOutliers(disturbances.outliers, {key, Stream::outliers}, recording.measurements);

  // faults last, since they spoil all that was measured
  SpoilLog(disturbances.faults, recording);
  LoseSamples(disturbances.faults.lost_samples, {key, Stream::lost_samples}, recording);
}

}  // namespace warmjoint
