// Runs of kept samples at one constant speed, each of which begins with what a lag still holds.
#pragma once

#include <warmjoint/prepared_log.h>

#include <Eigen/Core>
#include <vector>

namespace warmjoint {

/// Neighbouring samples of one segment that are all kept: positions among the kept samples.
struct KeptRun {
  Eigen::Index begin = 0;
  Eigen::Index end = 0;  // one past the last

  Eigen::Index size() const { return end - begin; }
};

/// The kept samples of a log, in runs.
struct KeptRuns {
  std::vector<Eigen::Index> samples;  // [n] of the log
  Eigen::VectorXd time;               // [n] s
  std::vector<KeptRun> runs;          // [R] all n samples, in order of time

  Eigen::Index count() const { return static_cast<Eigen::Index>(samples.size()); }
  Eigen::Index run_count() const { return static_cast<Eigen::Index>(runs.size()); }
  /// Time between two samples, the median within runs, s.
  double Step() const;
  /// Duration of a run, the median, s.
  double Duration() const;
};

/// A run ends where a sample is left out, a segment begins, or the joint is cold again
/// (LogSamples::starts).
KeptRuns FindRuns(const LogSamples& measurements, const Selection& selection);

}  // namespace warmjoint
