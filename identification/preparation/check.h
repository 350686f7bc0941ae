// What a recording holds, and what can be identified from it.
#pragma once

#include <string>
#include <vector>

#include "identification/preparation/friction_kind.h"
#include "identification/preparation/prepared_log.h"
#include "models/recording/measurements.h"
#include "models/recording/selection.h"

namespace warmjoint::inline identification {

/// How the samples lie in time.
struct SamplingCheck {
  Eigen::Index samples = 0;
  double duration = 0;     // s
  double step = 0;         // s, median
  double rate = 0;         // Hz, 1 / step
  double jitter = 0;       // standard deviation of the steps (gaps left out), share of the median
  int gaps = 0;            // sampling.h
  double longest_gap = 0;  // s
};

/// Segments at (almost) one speed.
struct SpeedLevel {
  double velocity = 0;  // rad/s or m/s, signed; mean over the segments' samples
  int segments = 0;
  Eigen::Index samples = 0;
};

/// How the joint moves.
struct MotionCheck {
  double constant_share = 0;  // share of the samples at a constant speed
  double rest_share = 0;      // share of the samples at rest
  int segments = 0;
  std::vector<SpeedLevel> levels;  // in order of velocity, 5 % wide
  double lower = 0, upper = 0;     // rad or m, travel
  double speed_noise = 0;          // rad/s or m/s, around constant speeds
  double speed_resolution = 0;     // rad/s or m/s; 0: not quantised
  double position_resolution = 0;  // rad or m, of positions that tell the speed; 0: not quantised
};

/// Whether friction of one kind can be identified, and why (not).
struct Excitation {
  FrictionKind kind = FrictionKind::coulomb;
  std::string what;  // the kind in words: "law asymmetric", ...
  bool sufficient = false;
  std::string reason;  // one sentence; where insufficient, it ends in the remedy
};

struct RecordingCheck {
  std::string source;
  JointKind joint = JointKind::rotary;
  std::string torque_unit;
  std::vector<std::string> notes;  // what reading made of it
  SamplingCheck sampling;
  MotionCheck motion;
  std::vector<std::string> faults;  // log_faults.h
  std::vector<Excitation> excitation;
};

/// Looks at a recording.
RecordingCheck CheckRecording(const PreparedLog& log);

/// The same of a recording that is not yet prepared.
RecordingCheck CheckRecording(const Measurements& measurements);

/// What the motion can tell about each kind of friction. Part of CheckRecording.
std::vector<Excitation> JudgeExcitation(const Measurements& measurements,
                                        const SamplingCheck& sampling, const MotionCheck& motion);

/// What `check` finds that the recording lacks to show friction of that kind, with its remedy; where it
/// lacks nothing, a doubt about the torque column.
std::string WhyNotConverged(const Measurements& measurements, FrictionKind kind);

}  // namespace warmjoint::inline identification
