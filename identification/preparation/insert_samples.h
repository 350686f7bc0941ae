// Samples put into a log between those that were taken.
#pragma once

#include <warmjoint/prepared_log.h>

#include <vector>

namespace warmjoint {

/// A sample to be put in.
struct InsertedSample {
  Eigen::Index after = 0;  // the sample before it
  double time = 0;         // s, between that sample and the next
  double position = 0;     // rad or m
  double velocity = 0;     // rad/s or m/s, until the next sample
};

/// A log with samples put in.
struct FilledLog {
  LogView view;
  /// Most of the path, as a share of all of it, that a drive which takes its time to reverse would
  /// not have travelled (PreparedLog::unresolved_path).
  double unresolved_path = 0;
};

/// Puts samples into a log that has none put in, ascending in time: with the torque and the other
/// columns of the sample behind, and not kept, so that the thermal filter alone sees them. Segments
/// keep their samples.
void InsertSamples(const std::vector<InsertedSample>& inserted, LogView& log);

/// Most of the path, rad or m, that a reversal from v0 to v1 may lack which is taken for a switch: a
/// ramp that no sample shows lasts twice the time to the nearer sample at most. nearer: that time, s;
/// v0, v1: rad/s or m/s. 0 where the speed does not turn.
double UnresolvedAt(double v0, double v1, double nearer);

/// The path sum |v| h, each velocity held until the next sample, rad or m.
double HeldPath(const Measurements& measurements);

}  // namespace warmjoint
