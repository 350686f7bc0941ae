#include <algorithm>

#include "models/foundation/bad_input.h"
#include "sim/plant/plant.h"

namespace warmjoint {
namespace {

constexpr Eigen::Index kMostCorners = 8;  // between two segments

/// Position of a recording at any time of it.
class RecordedPosition {
 public:
  explicit RecordedPosition(const Measurements& m) : m_(m) {}

  double At(double time) const {
    const double* begin = m_.time.data();
    const auto after = std::upper_bound(begin, begin + m_.size(), time) - begin;
    const auto i = std::clamp<Eigen::Index>(after, 1, m_.size() - 1);
    const double share = (time - m_.time[i - 1]) / (m_.time[i] - m_.time[i - 1]);
    return m_.position[i - 1] + share * (m_.position[i] - m_.position[i - 1]);
  }

  double MeanVelocity(double from, double to) const { return (At(to) - At(from)) / (to - from); }

 private:
  const Measurements& m_;
};

/// Distance under straight lines between corners, rad or m.
double Distance(const std::vector<VelocityCorner>& corners) {
  double distance = 0;
  for (size_t i = 1; i < corners.size(); ++i) {
    distance += (corners[i].time - corners[i - 1].time) *
                (corners[i].velocity + corners[i - 1].velocity) / 2;
  }
  return distance;
}

/// Corners strictly between two others, by the recorded motion. samples: recorded between them.
std::vector<VelocityCorner> Between(const VelocityCorner& from, const VelocityCorner& to,
                                    Eigen::Index samples, const RecordedPosition& position) {
  // at most every second sample, evenly in time
  const Eigen::Index n = std::min(kMostCorners, samples / 2);
  if (n < 1) return {};
  const double step = (to.time - from.time) / static_cast<double>(n + 1);
  std::vector<VelocityCorner> corners{from};
  for (Eigen::Index i = 1; i <= n; ++i) {
    const double time = from.time + static_cast<double>(i) * step;
    corners.push_back({time, position.MeanVelocity(time - step / 2, time + step / 2)});
  }
  corners.push_back(to);

  // the recorded distance: moving n inner corners by v adds n step v
  const double missing = position.At(to.time) - position.At(from.time) - Distance(corners);
  corners = {corners.begin() + 1, corners.end() - 1};
  for (VelocityCorner& corner : corners) {
    corner.velocity += missing / (static_cast<double>(n) * step);
  }
  return corners;
}

}  // namespace

Motion MotionOf(const Measurements& measurements, const Selection& selection) {
  const Eigen::VectorXd& time = measurements.time;
  const Eigen::Index last = measurements.size() - 1;
  if (selection.segments.empty()) {
    Refuse({measurements.source},
           "has no segment at constant speed to replay; record piecewise constant speeds");
  }

  // both ends of each segment, and of the recording
  const RecordedPosition position(measurements);
  std::vector<std::pair<VelocityCorner, Eigen::Index>> fixed;
  const auto fix = [&](Eigen::Index sample, double velocity) {
    if (fixed.empty() || sample > fixed.back().second) {
      fixed.push_back({{time[sample], velocity}, sample});
    }
  };
  if (selection.segments.front().begin > 0) fix(0, position.MeanVelocity(time[0], time[1]));
  for (const Segment& segment : selection.segments) {
    fix(segment.begin, segment.velocity);
    fix(segment.end - 1, segment.velocity);
  }
  fix(last, position.MeanVelocity(time[last - 1], time[last]));

  // corners between the ends follow the recorded motion
  Motion motion;
  motion.start = measurements.position[0];
  for (size_t i = 0; i < fixed.size(); ++i) {
    const auto& [corner, sample] = fixed[i];
    const bool within = i > 0 && corner.velocity == fixed[i - 1].first.velocity;
    if (i > 0 && !within) {
      const auto between =
          Between(fixed[i - 1].first, corner, sample - fixed[i - 1].second - 1, position);
      motion.corners.insert(motion.corners.end(), between.begin(), between.end());
    }
    motion.corners.push_back(corner);
  }
  for (VelocityCorner& corner : motion.corners) corner.time -= time[0];
  return motion;
}

}  // namespace warmjoint
