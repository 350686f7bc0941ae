#include "identification/preparation/segment_velocity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr double kOtherUnit =
    0.5;  // of the speed; why: a wrong unit or sign is off by more, a speed cut down to whole steps by less
constexpr double kHarmless = 1e-3;  // attenuation, or error of a speed
constexpr double kCertain = 4;      // standard errors; why 4: by chance 1 in 16 000
constexpr double kRounding = 1e-6;  // of the mean speed: less is no noise

/// A straight line through the kept samples of a segment.
struct Line {
  double mean = 0, slope = 0;  // at the mean time; 1/s
  double strays = 0;           // sum of squares around it
};

/// Times of the kept samples of a segment.
struct Times {
  double count = 0, mean = 0, spread = 0;  // s; sum of squares around the mean, s^2
  double duration = 0;                     // s, first to last
};

template <typename Use>
void ForKept(const Selection& selection, const Segment& segment, Use&& use) {
  for (Index i = segment.begin; i < segment.end; ++i) {
    if (selection.keep[i]) use(i);
  }
}

Times TimesOf(const Measurements& m, const Selection& selection, const Segment& segment) {
  Times times;
  double first = 0, last = 0;
  // mean time of the kept samples, and the sum of squares around it
  ForKept(selection, segment, [&](Index i) {
    if (times.count == 0) first = m.time[i];
    last = m.time[i];
    times.mean += m.time[i];
    ++times.count;
  });
  times.mean /= std::max(times.count, 1.0);
  times.duration = last - first;
  // squares around the mean time
  ForKept(selection, segment,
          [&](Index i) { times.spread += std::pow(m.time[i] - times.mean, 2); });
  return times;
}

Line FitLine(const Measurements& m, const Eigen::VectorXd& values, const Selection& selection,
             const Segment& segment, const Times& times) {
  Line line;
  // mean and slope by least squares
  ForKept(selection, segment, [&](Index i) {
    line.mean += values[i];
    line.slope += (m.time[i] - times.mean) * values[i];
  });
  line.mean /= times.count;
  line.slope /= times.spread;
  // squares that the line leaves
  ForKept(selection, segment, [&](Index i) {
    line.strays += std::pow(values[i] - line.mean - line.slope * (m.time[i] - times.mean), 2);
  });
  return line;
}

/// A segment with three kept samples or more.
struct Steady {
  const Segment* segment = nullptr;
  Times times;
  Line velocity, position;
};

/// All segments together.
struct Pooled {
  double count = 0, freedom = 0;
  double velocity_noise = 0, position_noise = 0;  // around the lines
  double mean_speed = 0, spread = 0;              // of |v| over segments: mean and variance

  double Attenuation(double noise_variance) const {
    return noise_variance / (noise_variance + spread);
  }
};

std::vector<Steady> SteadySegments(const Measurements& m, const Selection& selection) {
  std::vector<Steady> all;
  for (const Segment& segment : selection.segments) {
    const Times times = TimesOf(m, selection, segment);
    if (times.count < 3) continue;
    all.push_back({&segment, times, FitLine(m, m.velocity, selection, segment, times),
                   FitLine(m, m.position, selection, segment, times)});
    // an integral of the velocity tells it no better
    if (m.position_integrated) all.back().position.strays = std::numeric_limits<double>::infinity();
  }
  return all;
}

Pooled Pool(const std::vector<Steady>& all) {
  Pooled pooled;
  // one noise for all segments: what their lines leave, over the samples less two for each line
  for (const Steady& one : all) {
    pooled.count += one.times.count;
    pooled.freedom += one.times.count - 2;
    pooled.velocity_noise += one.velocity.strays;
    pooled.position_noise += one.position.strays;
    pooled.mean_speed += one.times.count * std::abs(one.velocity.mean);
  }
  // sums become deviations and means
  pooled.velocity_noise = std::sqrt(pooled.velocity_noise / pooled.freedom);
  pooled.position_noise = std::sqrt(pooled.position_noise / pooled.freedom);
  pooled.mean_speed /= pooled.count;
  // spread of the speeds among the segments, weighted by samples
  for (const Steady& one : all) {
    const double beyond = std::abs(one.velocity.mean) - pooled.mean_speed;
    pooled.spread += one.times.count * beyond * beyond / pooled.count;
  }
  return pooled;
}

/// A segment's velocity and its standard error, rad/s or m/s.
struct Velocity {
  double value = 0, error = 0;
};

/// As the velocities tell it, and as the positions do.
struct TwoVelocities {
  Velocity mean, slope;

  TwoVelocities(const Steady& one, const Pooled& pooled)
      : mean{one.velocity.mean, pooled.velocity_noise / std::sqrt(one.times.count)},
        slope{one.position.slope, std::sqrt(2.0) * pooled.position_noise / one.times.duration} {}
};

Velocity BestVelocity(const Steady& one, const Pooled& pooled) {
  const auto [mean, slope] = TwoVelocities(one, pooled);
  const bool agrees =
      std::abs(slope.value - mean.value) <= kCertain * std::hypot(mean.error, slope.error);
  return agrees && slope.error < mean.error ? slope : mean;
}

}  // namespace

std::optional<SegmentVelocity> TakeSegmentVelocity(const Measurements& measurements,
                                                   const Selection& selection) {
  const std::vector<Steady> all = SteadySegments(measurements, selection);
  if (all.empty()) return std::nullopt;
  const Pooled pooled = Pool(all);
  // nothing to gain where noise is rounding alone, or takes hardly anything off a slope
  const double variance = pooled.velocity_noise * pooled.velocity_noise;
  if (!(pooled.velocity_noise > kRounding * pooled.mean_speed) ||
      pooled.Attenuation(variance) <= kHarmless) {
    return std::nullopt;
  }

  SegmentVelocity taken{
      measurements, {pooled.velocity_noise, pooled.Attenuation(variance), 0, pooled.mean_speed}};
  double errors = 0;  // of a velocity, mean square over the samples
  // each segment moves at its own best velocity, and drifts where its slope is beyond doubt
  for (const Steady& one : all) {
    const Velocity velocity = BestVelocity(one, pooled);
    const bool drifts =
        std::abs(one.velocity.slope) * std::sqrt(one.times.spread) > kCertain * taken.noise.noise;
    const double slope = drifts ? one.velocity.slope : 0;
    errors += one.times.count * velocity.error * velocity.error / pooled.count;
    ForKept(selection, *one.segment, [&](Index i) {
      taken.measurements.velocity[i] =
          velocity.value + slope * (measurements.time[i] - one.times.mean);
    });
  }
  // what the errors that remain take off a slope
  taken.noise.left = pooled.Attenuation(errors);
  return taken;
}

std::optional<double> CoarseStep(const Measurements& measurements, const Selection& selection) {
  const double step = Resolution(measurements.velocity);
  if (step == 0) return std::nullopt;
  const std::vector<Steady> all = SteadySegments(measurements, selection);
  if (all.empty()) return std::nullopt;
  const Pooled pooled = Pool(all);

  // mean squares of the differences and of their standard errors
  double differences = 0, errors = 0;
  for (const Steady& one : all) {
    const auto [mean, slope] = TwoVelocities(one, pooled);
    const double share = one.times.count / pooled.count;
    differences += share * std::pow(mean.value - slope.value, 2);
    errors += share * (std::pow(mean.error, 2) + std::pow(slope.error, 2));
  }
  const double difference = std::sqrt(differences);
  const bool shows = difference > kCertain * std::sqrt(errors);
  const bool matters = difference > kHarmless * pooled.mean_speed;
  const double rounding = std::min(step, kOtherUnit * pooled.mean_speed);
  return shows && matters && difference <= rounding ? std::optional(step) : std::nullopt;
}

}  // namespace warmjoint
