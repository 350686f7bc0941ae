// Faults of sensors, clocks and files that spoil a log. All at their defaults: none.
#pragma once

namespace warmjoint::inline scenarios {

/// The torque sensor drifts: its offset and its gain change evenly in time.
struct SensorDrift {
  double offset = 0;  // N.m or N in an hour
  double gain = 0;    // share in an hour

  bool operator==(const SensorDrift&) const = default;
};

/// From a moment on the torque is logged with another factor, as behind another gear or range.
struct GainStep {
  double factor = 1;
  double time = 0;  // s

  bool operator==(const GainStep&) const = default;
};

/// The stamps run by another clock: factor t, and each is off by up to half of `jitter`, evenly spread over the samples.
struct Clock {
  double factor = 1;
  double jitter = 0;  // s

  bool operator==(const Clock&) const = default;
};

/// Factors on the columns as they are logged: wrong units and signs.
struct ColumnScale {
  double position = 1;
  double velocity = 1;
  double torque = 1;

  bool operator==(const ColumnScale&) const = default;
};

/// A column keeps its value for a while.
struct Stuck {
  double time = 0;      // s
  double duration = 0;  // s

  bool operator==(const Stuck&) const = default;
};

/// The torque cannot leave -level to level.
struct Clipped {
  double level = 0;  // N.m or N; 0: it can

  bool operator==(const Clipped&) const = default;
};

/// Torques below a level are logged as 0, others less that level.
struct DeadBand {
  double level = 0;  // N.m or N

  bool operator==(const DeadBand&) const = default;
};

/// The logged torque comes in whole steps.
struct TorqueResolution {
  double resolution = 0;  // N.m or N

  bool operator==(const TorqueResolution&) const = default;
};

/// The logged torque is that of some samples ago.
struct LateTorque {
  double samples = 0;  // a whole number

  bool operator==(const LateTorque&) const = default;
};

/// The log begins later than the motion: what came before is not in it.
struct CutStart {
  double time = 0;  // s

  bool operator==(const CutStart&) const = default;
};

/// The log holds nothing of a while in which the joint moves on.
struct Gap {
  double time = 0;      // s
  double duration = 0;  // s

  bool operator==(const Gap&) const = default;
};

/// Single samples that the log lacks, at random; the first and the last are there.
struct LostSamples {
  double fraction = 0;  // of the samples, below 1

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

  bool operator==(const SensorFaults&) const = default;
};

}  // namespace warmjoint::inline scenarios
