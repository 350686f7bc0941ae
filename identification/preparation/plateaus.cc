#include "identification/preparation/plateaus.h"

#include <algorithm>
#include <cmath>

#include "identification/preparation/constant_speed_numbers.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using namespace constant_speed;

/// Whether v jumps between samples i - 1 and i while it is steady before and after.
bool Jumps(const Eigen::VectorXd& v, Index i, const VelocityScale& scale) {
  const double jump = std::abs(v[i] - v[i - 1]);
  const double before = i >= 2 ? std::abs(v[i - 1] - v[i - 2]) : 0;
  const double after = i + 1 < v.size() ? std::abs(v[i + 1] - v[i]) : 0;
  const double smallest =
      std::max({kJumpDeviations * scale.noise, kLevels * scale.resolution, 1e-9 * std::abs(v[i])});
  return jump > smallest && jump > kJumpOverBeside * std::max(before, after);
}

bool IsTimeGap(const Eigen::VectorXd& time, Index i, const VelocityScale& scale) {
  return time[i] - time[i - 1] > 3 * scale.step;
}

std::vector<Segment> Grow(const Measurements& measurements, const VelocityScale& scale) {
  const Eigen::VectorXd& v = measurements.velocity;
  std::vector<Segment> runs;
  Index begin = 0;
  double sum = v[0];
  // a run goes on while the speed stays within a band around its mean
  for (Index i = 1; i <= v.size(); ++i) {
    const auto length = static_cast<double>(i - begin);
    const double mean = sum / length;

    // the mean of a short run is itself uncertain
    const bool goes_on = i < v.size() &&
                         std::abs(v[i] - mean) <= scale.Band(mean) * std::sqrt(1 + 1 / length) &&
                         !IsTimeGap(measurements.time, i, scale) && !Jumps(v, i, scale);
    // the run grows, or ends in front of this sample
    if (goes_on) {
      sum += v[i];
    } else {
      runs.push_back({begin, i, mean});
      begin = i;
      sum = i < v.size() ? v[i] : 0;
    }
  }
  return runs;
}

/// Whether a run is no more than a few outliers between two runs at one speed.
bool Interrupts(const Segment& run, const Segment& before, const Segment& after,
                const Eigen::VectorXd& time, const VelocityScale& scale) {
  const Index around = std::min(before.end - before.begin, after.end - after.begin);
  const bool is_brief = kOutliers * (run.end - run.begin) <= around;
  const bool is_one_speed =
      std::abs(before.velocity - after.velocity) <= scale.Band(before.velocity) / 2;
  return is_brief && is_one_speed && !IsTimeGap(time, run.begin, scale) &&
         !IsTimeGap(time, run.end, scale);
}

}  // namespace

std::vector<Segment> CutIntoRuns(const Measurements& measurements, const VelocityScale& scale) {
  const std::vector<Segment> runs = Grow(measurements, scale);
  std::vector<Segment> joined;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    // a few outliers between two runs of one speed do not end it
    const bool joins = !joined.empty() && i + 1 < runs.size() &&
                       Interrupts(runs[i], joined.back(), runs[i + 1], measurements.time, scale);
    if (joins) {
      joined.back().end = runs[++i].end;
    } else {
      joined.push_back(runs[i]);
    }
  }
  return joined;
}

}  // namespace warmjoint
