#include "identification/forward/predict.h"

#include "identification/forward/bristle_course.h"
#include "identification/forward/intervals.h"
#include "identification/forward/map_points.h"

namespace warmjoint::inline identification {
namespace {

/// Sum of all maps, N.m or N.
double MapForce(const std::vector<FrictionMap>& maps, const MapPoint<double>& point) {
  double force = 0;
  for (const FrictionMap& map : maps) force += EvaluateMap(map, point);
  return force;
}

/// What the bristle of LuGre adds to its steady force, N.m or N. [N]
Eigen::VectorXd PreSlidingForce(const std::vector<double>& values, const Measurements& m,
                                BristleStart start) {
  const auto n = static_cast<size_t>(m.size());
  std::vector<double> force(n), load(n);
  const Eigen::VectorXd torque = start == BristleStart::torque ? m.torque : Eigen::VectorXd();
  BristleCourse(m.time, m.velocity, m.starts, torque).Run(values.data(), force.data(), load.data());
  for (size_t i = 0; i < n; ++i) {
    force[i] -= LuGre::Force(m.velocity[static_cast<Eigen::Index>(i)], values.data());
  }
  return Eigen::Map<const Eigen::VectorXd>(force.data(), m.size());
}

}  // namespace

Prediction PredictFriction(const FrictionDescription& friction, const Measurements& measurements,
                           double initial_energy, BristleStart bristle) {
  const Law& law = *FindLaw(friction.law);
  const std::vector<double> values = LawValues(friction);
  const Eigen::Index n = measurements.size();
  const MapPoints points = friction.maps.empty() ? MapPoints() : PointsOf(measurements);
  Prediction prediction{Eigen::VectorXd(n), Eigen::VectorXd(n), n};
  Intervals intervals;
  std::vector<ThermalHold> holds;
  if (friction.thermal && n > 1) {
    intervals = FindIntervals(measurements.time);
    holds = Holds(intervals, *friction.thermal);
  }

  double energy = initial_energy;
  size_t start = 0;  // the next cold one
  for (Eigen::Index i = 0; i < n; ++i) {
    if (start < measurements.starts.size() && measurements.starts[start] == i) {
      energy = 0;
      ++start;
    }
    const double v = measurements.velocity[i];
    double force = WarmForce(v, law.force(v, values.data()), energy);
    if (!friction.maps.empty() && v != 0) {
      MapPoint<double> point = PointAt(points, i);
      point[static_cast<size_t>(MapQuantity::energy)] = energy;
      force += MapForce(friction.maps, point);
    }
    prediction.force[i] = force;
    prediction.energy[i] = energy;
    if (FeedsItself(v, force) && prediction.feeds_itself == n) prediction.feeds_itself = i;

    // hold the loss until the next sample
    if (!friction.thermal || i + 1 == n) continue;
    const ThermalHold& hold = holds[intervals.which[i]];
    energy = ThermalStep(hold.gain, hold.pole, energy, Loss(v, force));
  }
  if (law.name == LuGre::name && n > 1)
    prediction.force += PreSlidingForce(values, measurements, bristle);
  return prediction;
}

}  // namespace warmjoint::inline identification
