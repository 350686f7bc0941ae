#include "identification/preparation/check.h"

#include <warmjoint/prepared_log.h>

#include <algorithm>
#include <cmath>

#include "identification/preparation/position_noise.h"
#include "identification/preparation/velocity_scale.h"
#include "models/recording/sampling.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

SamplingCheck CheckSampling(const VectorXd& time, double step) {
  const Index n = time.size();
  SamplingCheck check;
  check.samples = n;
  check.duration = time[n - 1] - time[0];
  check.step = step;
  check.rate = 1 / step;

  // steps within the recording tell the jitter; longer ones are gaps
  double squares = 0;
  for (Index i = 1; i < n; ++i) {
    const double taken = time[i] - time[i - 1];
    if (taken > kGapSteps * step) {
      ++check.gaps;
      check.longest_gap = std::max(check.longest_gap, taken);
    } else {
      squares += (taken - step) * (taken - step);
    }
  }
  // jitter in steps: root mean square of what a step differs from the median one
  const auto steps = static_cast<double>(std::max<Index>(n - 1 - check.gaps, 1));
  check.jitter = std::sqrt(squares / steps) / step;
  return check;
}

/// Segments in groups of one speed: a group ends where the next speed is 5 % further on.
std::vector<SpeedLevel> Levels(std::vector<Segment> segments) {
  std::sort(segments.begin(), segments.end(),
            [](const Segment& a, const Segment& b) { return a.velocity < b.velocity; });
  std::vector<SpeedLevel> levels;
  double first = 0;  // slowest of the group
  for (const Segment& segment : segments) {
    const Index samples = segment.end - segment.begin;
    const bool is_new = levels.empty() || segment.velocity - first > 0.05 * std::abs(first);
    // a new level begins where the speed has grown by 5 %
    if (is_new) {
      levels.push_back({0, 0, 0});
      first = segment.velocity;
    }
    // the mean speed of the level, weighted by samples
    SpeedLevel& level = levels.back();
    const auto before = static_cast<double>(level.samples), added = static_cast<double>(samples);
    level.velocity = (before * level.velocity + added * segment.velocity) / (before + added);
    level.samples += samples;
    ++level.segments;
  }
  return levels;
}

MotionCheck CheckMotion(const Measurements& measurements, const VelocityScale& scale,
                        const Selection& selection) {
  const auto n = static_cast<double>(measurements.size());
  MotionCheck check;
  // shares of the samples that identification uses, and at rest
  check.constant_share = static_cast<double>(selection.count()) / n;
  const auto resting = (measurements.velocity.array().abs() <= scale.Rest()).count();
  check.rest_share = static_cast<double>(resting) / n;
  check.segments = static_cast<int>(selection.segments.size());
  check.levels = Levels(selection.segments);
  // travel, and what the velocity itself leaves unknown
  check.lower = measurements.position.minCoeff();
  check.upper = measurements.position.maxCoeff();
  check.speed_noise = scale.noise;
  check.speed_resolution = scale.resolution;
  return check;
}

}  // namespace

RecordingCheck CheckRecording(const PreparedLog& log) {
  const auto& [measurements, selection] = log.taken();
  const VelocityScale scale = MeasureVelocity(measurements);
  RecordingCheck check;
  // what was read
  check.source = measurements.source;
  check.joint = measurements.joint;
  check.torque_unit = measurements.torque_unit;
  check.notes = measurements.notes;
  // what was measured, and what that lets the user identify
  check.sampling = CheckSampling(measurements.time, scale.step);
  check.motion = CheckMotion(measurements, scale, selection);
  if (log.source() == MotionSource::positions) {
    check.motion.position_resolution = MeasurePositionNoise(measurements.position).resolution;
  }
  check.faults = log.faults();
  check.excitation = JudgeExcitation(measurements, check.sampling, check.motion);
  return check;
}

RecordingCheck CheckRecording(const Measurements& measurements) {
  return CheckRecording(Prepare(measurements));
}

std::string WhyNotConverged(const Measurements& measurements, FrictionKind kind) {
  for (const Excitation& one : CheckRecording(measurements).excitation) {
    if (one.kind == kind && !one.sufficient) return one.reason;
  }
  return "does the torque column hold friction?";
}

}  // namespace warmjoint
