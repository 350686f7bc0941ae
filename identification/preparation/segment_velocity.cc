#include "identification/preparation/segment_velocity.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "identification/preparation/speed_change.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr double kOtherUnit =
    0.5;  // of the speed; why: the error by a wrong unit or sign is larger, that of a speed cut down to whole steps is smaller
constexpr double kHarmless = 1e-3;  // attenuation, or error of a speed
constexpr double kCertain = 4;      // standard errors; why 4: by chance 1 in 16 000
constexpr double kRounding = 1e-6;  // of the mean speed: a smaller value is not noise

/// A segment with three kept samples or more: lines through their velocities and positions.
struct Steady {
  const Segment* segment = nullptr;
  StraightLine velocity, position;
  double duration = 0;  // s
};

/// All segments together.
struct Pooled {
  double count = 0;
  double velocity_noise = 0, position_noise = 0;  // around the lines
  double mean_speed = 0, spread = 0;              // of |v| over segments: mean and variance

  double Attenuation(double noise_variance) const {
    return noise_variance / (noise_variance + spread);
  }
};

std::vector<Steady> SteadySegments(const Measurements& m, const Selection& selection) {
  std::vector<Steady> all;
  for (const Segment& segment : selection.segments) {
    const auto fit = [&](const Eigen::VectorXd& values) {
      return FitStraightLine(m.time, values, segment.begin, segment.end - 1, selection.keep);
    };
    const auto velocity = fit(m.velocity), position = fit(m.position);
    if (!velocity || velocity->samples < 3) continue;
    all.push_back(
        {&segment, *velocity, *position, m.time[segment.end - 1] - m.time[segment.begin]});
    // positions that are an integral of the velocity have no information of their own
    if (m.position_integrated) all.back().position.deviation = kInfinity;
  }
  return all;
}

Pooled Pool(const std::vector<Steady>& all) {
  Pooled pooled;
  double degrees_of_freedom = 0, velocity_squares = 0, position_squares = 0;
  // one noise for all segments: what their lines leave, over the samples less two for each line
  for (const Steady& one : all) {
    const double samples = one.velocity.samples;
    pooled.count += samples;
    degrees_of_freedom += samples - 2;
    velocity_squares += (samples - 2) * std::pow(one.velocity.deviation, 2);
    position_squares += (samples - 2) * std::pow(one.position.deviation, 2);
    pooled.mean_speed += samples * std::abs(one.velocity.value);
  }
  pooled.velocity_noise = std::sqrt(velocity_squares / degrees_of_freedom);
  pooled.position_noise = std::sqrt(position_squares / degrees_of_freedom);
  pooled.mean_speed /= pooled.count;
  // spread of the speeds among the segments, weighted by samples
  for (const Steady& one : all) {
    const double beyond = std::abs(one.velocity.value) - pooled.mean_speed;
    pooled.spread += one.velocity.samples * beyond * beyond / pooled.count;
  }
  return pooled;
}

/// A segment's velocity and its standard error, rad/s or m/s.
struct Velocity {
  double value = 0, error = 0;
};

/// The velocity by the velocities, and by the positions.
struct TwoVelocities {
  Velocity mean, slope;

  TwoVelocities(const Steady& one, const Pooled& pooled)
      : mean{one.velocity.value, pooled.velocity_noise / std::sqrt(one.velocity.samples)},
        slope{one.position.slope, std::sqrt(2.0) * pooled.position_noise / one.duration} {}
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
  // there is nothing to gain where noise is only rounding, or hardly attenuates a slope
  const double variance = pooled.velocity_noise * pooled.velocity_noise;
  if (!(pooled.velocity_noise > kRounding * pooled.mean_speed) ||
      pooled.Attenuation(variance) <= kHarmless) {
    return std::nullopt;
  }

  SegmentVelocity taken{
      measurements.velocity,
      {.noise = pooled.velocity_noise, .mean_speed = pooled.mean_speed, .spread = pooled.spread}};
  double errors = 0;  // of a velocity, mean square over the samples
  // each segment has its own best velocity, which drifts where its slope is beyond doubt
  for (const Steady& one : all) {
    const Velocity velocity = BestVelocity(one, pooled);
    const bool drifts = std::abs(one.velocity.slope) * std::sqrt(one.velocity.spread) >
                        kCertain * taken.noise.noise;
    const double slope = drifts ? one.velocity.slope : 0;
    errors += one.velocity.samples * velocity.error * velocity.error / pooled.count;
    for (Index i = one.segment->begin; i < one.segment->end; ++i) {
      if (!selection.keep[i]) continue;
      taken.velocity[i] = velocity.value + slope * (measurements.time[i] - one.velocity.time);
    }
  }
  // the attenuation of a slope by the errors that remain
  taken.noise.error = std::sqrt(errors);
  taken.noise.FindShares();
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
    const double share = one.velocity.samples / pooled.count;
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
