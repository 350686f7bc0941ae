#include "identification/forward/map_points.h"

#include "models/recording/measurements.h"

namespace warmjoint {

MapPoints PointsOf(const LogSamples& measurements, const Eigen::VectorXd& energy) {
  MapPoints points = MapPoints::Zero(measurements.size(), 5);
  const auto column = [&](MapQuantity quantity) { return points.col(static_cast<int>(quantity)); };
  column(MapQuantity::position) = measurements.position;
  column(MapQuantity::motor_position) = MotorPosition(measurements);
  column(MapQuantity::velocity) = measurements.velocity;
  if (energy.size() > 0) column(MapQuantity::energy) = energy;
  if (measurements.load) column(MapQuantity::load) = *measurements.load;
  return points;
}

MapPoint<double> PointAt(const MapPoints& points, Eigen::Index row) {
  MapPoint<double> point;
  for (size_t i = 0; i < point.size(); ++i) point[i] = points(row, static_cast<Eigen::Index>(i));
  return point;
}

}  // namespace warmjoint
