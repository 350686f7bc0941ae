// Faults of sensors, clocks and files that spoil a log. All at their defaults: none.
#pragma once

#include <warmjoint/field.h>

namespace warmjoint {

struct SensorDrift {
  double offset = 0;
  double gain = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("offset", &offset, WithDefault("N.m", "change in an hour"));
    a->Field("gain", &gain, WithDefault("", "change in an hour, a share"));
  }
};

struct GainStep {
  double factor = 1;
  double time = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("factor", &factor, Needed("", "on the torque"));
    a->Field("time", &time, Needed("s", "of the step", kNotNegative));
  }
};

/// The stamps run by another clock: factor t, and each is off by up to half of `jitter`, evenly spread over the samples.
struct Clock {
  double factor = 1;
  double jitter = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("factor", &factor, WithDefault("", "on the stamps", kPositive));
    a->Field("jitter", &jitter,
             WithDefault("s", "between the earliest and the latest offset", kNotNegative));
  }
};

struct ColumnScale {
  double position = 1;
  double velocity = 1;
  double torque = 1;

  template <class A>
  void Serialize(A* a) {
    a->Field("position", &position, WithDefault("", "factor"));
    a->Field("velocity", &velocity, WithDefault("", "factor"));
    a->Field("torque", &torque, WithDefault("", "factor"));
  }
};

struct TimeSpan {
  double time = 0;
  double duration = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("time", &time, Needed("s", "when it begins", kNotNegative));
    a->Field("duration", &duration, Needed("s", "how long it lasts", kNotNegative));
  }
};

struct Clipped {
  double level = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("level", &level, Needed("N.m", "largest torque that is logged; 0: any", kNotNegative));
  }
};

struct DeadBand {
  double level = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("level", &level, Needed("N.m", "largest torque that is logged as 0", kNotNegative));
  }
};

struct TorqueResolution {
  double resolution = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("resolution", &resolution, Needed("N.m", "size of a step", kNotNegative));
  }
};

struct Delay {
  int samples = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("samples", &samples, Needed("", "how many samples it is late", kNotNegative));
  }
};

struct CutStart {
  double time = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("time", &time, Needed("s", "of the first sample", kNotNegative));
  }
};

struct LostSamples {
  double fraction = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("fraction", &fraction,
             Needed("", "share of the samples", {.at_least = 0, .below = 1}));
  }
};

struct SensorFaults {
  SensorDrift sensor_drift;
  GainStep gain_step;
  Clock clock;
  ColumnScale column_scale;
  TimeSpan stuck_position, stuck_velocity, stuck_torque;
  Clipped clipped;
  DeadBand dead_band;
  TorqueResolution torque_resolution;
  Delay late_torque;
  CutStart cut_start;
  TimeSpan gap;
  LostSamples lost_samples;
  bool restarted_clock = false;
  bool unsigned_torque = false;
  bool reversed_torque = false;
  bool swapped_columns = false;
  bool without_load = false;

  template <class A>
  void Serialize(A* a) {
    a->Field("sensor_drift", &sensor_drift,
             LeftOut("offset and gain of the logged torque change evenly in time"));
    a->Field("gain_step", &gain_step,
             LeftOut("from a moment on the torque is logged with another factor, as after "
                     "another gear or range"));
    a->Field("clock", &clock, LeftOut("stamps of a wrong or uneven clock"));
    a->Field("column_scale", &column_scale, LeftOut("columns in wrong units or with wrong signs"));
    a->Field("stuck_position", &stuck_position,
             LeftOut("the position keeps its value for a while"));
    a->Field("stuck_velocity", &stuck_velocity,
             LeftOut("the velocity keeps its value for a while"));
    a->Field("stuck_torque", &stuck_torque, LeftOut("the torque keeps its value for a while"));
    a->Field("clipped", &clipped, LeftOut("the logged torque cannot leave -level to level"));
    a->Field("dead_band", &dead_band,
             LeftOut("small torques are logged as 0, others less a level"));
    a->Field("torque_resolution", &torque_resolution,
             LeftOut("the logged torque comes in whole steps"));
    a->Field("late_torque", &late_torque, LeftOut("the logged torque is that of some samples ago"));
    a->Field("cut_start", &cut_start,
             LeftOut("the log begins later than the motion: what came before is not in it"));
    a->Field("gap", &gap, LeftOut("the log holds nothing of a while in which the joint moves on"));
    a->Field(
        "lost_samples", &lost_samples,
        LeftOut("single samples that the log lacks, at random; the first and the last are there"));
    a->Flag("restarted_clock", &restarted_clock, "the first stamp is 0, wherever the log begins");
    a->Flag("unsigned_torque", &unsigned_torque, "the size of the torque alone is logged");
    a->Flag("reversed_torque", &reversed_torque,
            "the torque runs from the end of the log to its beginning");
    a->Flag("swapped_columns", &swapped_columns,
            "torque under the name of velocity, and the other way round");
    a->Flag("without_load", &without_load, "a load that acts and is not logged");
  }
};

}  // namespace warmjoint
