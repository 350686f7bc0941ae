// Faults of sensors, clocks and files that spoil a log. All at their defaults: none.
#pragma once

#include <warmjoint/field.h>

namespace warmjoint {

/// The torque sensor drifts: its offset and its gain change evenly in time.
struct SensorDrift {
  double offset = 0;  // N.m or N in an hour
  double gain = 0;    // share in an hour

  template <class A>
  void Serialize(A* a) {
    a->Field("offset", &offset, {.unit = "N.m"});
    a->Field("gain", &gain);
  }

  bool operator==(const SensorDrift&) const = default;
};

/// From a moment on the torque is logged with another factor, as behind another gear or range.
struct GainStep {
  double factor = 1;
  double time = 0;  // s

  template <class A>
  void Serialize(A* a) {
    a->Field("factor", &factor, {.needed = kGiveNumber});
    a->Field("time", &time, {.unit = "s", .bounds = {.at_least = 0}, .needed = kGiveNumber});
  }

  bool operator==(const GainStep&) const = default;
};

/// The stamps run by another clock: factor t, and each is off by up to half of `jitter`, evenly spread over the samples.
struct Clock {
  double factor = 1;
  double jitter = 0;  // s

  template <class A>
  void Serialize(A* a) {
    a->Field("factor", &factor, {.bounds = {.above = 0}});
    a->Field("jitter", &jitter, {.unit = "s", .bounds = {.at_least = 0}});
  }

  bool operator==(const Clock&) const = default;
};

/// Factors on the columns as they are logged: wrong units and signs.
struct ColumnScale {
  double position = 1;
  double velocity = 1;
  double torque = 1;

  template <class A>
  void Serialize(A* a) {
    a->Field("position", &position);
    a->Field("velocity", &velocity);
    a->Field("torque", &torque);
  }

  bool operator==(const ColumnScale&) const = default;
};

/// A column keeps its value for a while.
struct Stuck {
  double time = 0;      // s
  double duration = 0;  // s

  template <class A>
  void Serialize(A* a) {
    a->Field("time", &time, {.unit = "s", .bounds = {.at_least = 0}, .needed = kGiveNumber});
    a->Field("duration", &duration,
             {.unit = "s", .bounds = {.at_least = 0}, .needed = kGiveNumber});
  }

  bool operator==(const Stuck&) const = default;
};

/// The torque cannot leave -level to level.
struct Clipped {
  double level = 0;  // N.m or N; 0: it can

  template <class A>
  void Serialize(A* a) {
    a->Field("level", &level, {.unit = "N.m", .bounds = {.at_least = 0}, .needed = kGiveNumber});
  }

  bool operator==(const Clipped&) const = default;
};

/// Torques below a level are logged as 0, others less that level.
struct DeadBand {
  double level = 0;  // N.m or N

  template <class A>
  void Serialize(A* a) {
    a->Field("level", &level, {.unit = "N.m", .bounds = {.at_least = 0}, .needed = kGiveNumber});
  }

  bool operator==(const DeadBand&) const = default;
};

/// The logged torque comes in whole steps.
struct TorqueResolution {
  double resolution = 0;  // N.m or N

  template <class A>
  void Serialize(A* a) {
    a->Field("resolution", &resolution,
             {.unit = "N.m", .bounds = {.at_least = 0}, .needed = kGiveNumber});
  }

  bool operator==(const TorqueResolution&) const = default;
};

/// The logged torque is that of some samples ago.
struct LateTorque {
  int samples = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("samples", &samples, {.bounds = {.at_least = 0}, .needed = kGiveNumber});
  }

  bool operator==(const LateTorque&) const = default;
};

/// The log begins later than the motion: what came before is not in it.
struct CutStart {
  double time = 0;  // s

  template <class A>
  void Serialize(A* a) {
    a->Field("time", &time, {.unit = "s", .bounds = {.at_least = 0}, .needed = kGiveNumber});
  }

  bool operator==(const CutStart&) const = default;
};

/// The log holds nothing of a while in which the joint moves on.
struct Gap {
  double time = 0;      // s
  double duration = 0;  // s

  template <class A>
  void Serialize(A* a) {
    a->Field("time", &time, {.unit = "s", .bounds = {.at_least = 0}, .needed = kGiveNumber});
    a->Field("duration", &duration,
             {.unit = "s", .bounds = {.at_least = 0}, .needed = kGiveNumber});
  }

  bool operator==(const Gap&) const = default;
};

/// Single samples that the log lacks, at random; the first and the last are there.
struct LostSamples {
  double fraction = 0;  // of the samples, below 1

  template <class A>
  void Serialize(A* a) {
    a->Field("fraction", &fraction, {.bounds = {.at_least = 0, .below = 1}, .needed = kGiveNumber});
  }

  bool operator==(const LostSamples&) const = default;
};

struct SensorFaults {
  SensorDrift sensor_drift;
  GainStep gain_step;
  Clock clock;
  ColumnScale column_scale;
  Stuck stuck_position, stuck_velocity, stuck_torque;
  Clipped clipped;
  DeadBand dead_band;
  TorqueResolution torque_resolution;
  LateTorque late_torque;
  CutStart cut_start;
  Gap gap;
  LostSamples lost_samples;
  bool restarted_clock = false;  // the first stamp is 0, wherever the log begins
  bool unsigned_torque = false;  // its size alone is logged
  bool reversed_torque = false;  // the column runs from the end of the log to its beginning
  bool swapped_columns = false;  // torque under the name of velocity, and the other way round
  bool without_load = false;     // a load that acts and is not logged

  template <class A>
  void Serialize(A* a) {
    constexpr FieldInfo absent{.at_default = AtDefault::left_out};
    a->Field("sensor_drift", &sensor_drift, absent);
    a->Field("gain_step", &gain_step, absent);
    a->Field("clock", &clock, absent);
    a->Field("column_scale", &column_scale, absent);
    a->Field("stuck_position", &stuck_position, absent);
    a->Field("stuck_velocity", &stuck_velocity, absent);
    a->Field("stuck_torque", &stuck_torque, absent);
    a->Field("clipped", &clipped, absent);
    a->Field("dead_band", &dead_band, absent);
    a->Field("torque_resolution", &torque_resolution, absent);
    a->Field("late_torque", &late_torque, absent);
    a->Field("cut_start", &cut_start, absent);
    a->Field("gap", &gap, absent);
    a->Field("lost_samples", &lost_samples, absent);
    a->Flag("restarted_clock", &restarted_clock);
    a->Flag("unsigned_torque", &unsigned_torque);
    a->Flag("reversed_torque", &reversed_torque);
    a->Flag("swapped_columns", &swapped_columns);
    a->Flag("without_load", &without_load);
  }

  bool operator==(const SensorFaults&) const = default;
};

}  // namespace warmjoint
