#include "sim/plant/sensor_faults.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "models/foundation/low_pass.h"
#include "models/recording/measurements.h"

namespace warmjoint::inline sim {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kHour = 3600;  // s

/// The values of some samples ago; the first one before there are any.
VectorXd Delayed(const VectorXd& values, double samples) {
  const auto late = static_cast<Index>(std::min(samples, static_cast<double>(values.size())));
  VectorXd delayed = VectorXd::Constant(values.size(), values.size() > 0 ? values[0] : 0);
  delayed.tail(values.size() - late) = values.head(values.size() - late);
  return delayed;
}

/// Keeps a value for a while.
void Stick(const Stuck& stuck, const VectorXd& time, VectorXd& column) {
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
  for (VectorXd* column : {&truth.velocity, &truth.force, &truth.loss, &truth.energy}) {
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

}  // namespace

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

void SpoilLog(const SensorFaults& faults, Simulation& recording) {
  if (faults == SensorFaults{}) return;
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

}  // namespace warmjoint::inline sim
