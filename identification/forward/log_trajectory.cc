#include "identification/forward/log_trajectory.h"

#include "identification/preparation/delayed_motion.h"
#include "models/friction/along_motion.h"
#include "models/recording/measurements.h"

namespace warmjoint {

JointTrajectory TrajectoryOf(const LogSamples& log, BristleStart bristle) {
  JointTrajectory trajectory{log.time, log.velocity, log.position};
  // the motor's own sensor, or the gear
  trajectory.motor_position = MotorPosition(log);
  // what the log has in addition to its motion
  if (log.load) trajectory.load = *log.load;
  if (log.mean_speed && log.loss_velocity) {
    trajectory.mean_speed = *log.mean_speed;
    trajectory.loss_velocity = *log.loss_velocity;
  }
  if (bristle == BristleStart::torque) trajectory.torque = log.torque;
  trajectory.starts = log.further_starts;
  return trajectory;
}

std::optional<LogView> Followed(const LogSamples& logged, const Selection& asked,
                                const FollowedBy& model) {
  const bool is_late = model.delay && logged.acceleration;
  const bool is_loaded = model.load && !logged.load;
  if (!is_late && !is_loaded) return std::nullopt;
  LogView view = is_late ? Delayed({logged, asked}, *model.delay) : LogView{logged, asked};
  LogSamples& m = view.measurements;
  if (is_loaded) m.load = model.load->Torque(m.position);
  return view;
}

Prediction PredictFriction(const Friction& friction, const LogSamples& log,
                           const ThermalStart& start, BristleStart bristle) {
  return AlongMotion(friction).Predict(TrajectoryOf(log, bristle), start);
}

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
