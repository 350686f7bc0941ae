#include "identification/forward/log_trajectory.h"

#include "models/friction/along_motion.h"
#include "models/recording/measurements.h"

namespace warmjoint {

JointTrajectory TrajectoryOf(const LogSamples& log, BristleStart bristle) {
  JointTrajectory trajectory{log.time, log.velocity, log.position};
  // the motor's own sensor, or the gear
  trajectory.motor_position = MotorPosition(log);
  // what the log has beside its motion
  if (log.load) trajectory.load = *log.load;
  if (log.mean_speed && log.loss_velocity) {
    trajectory.mean_speed = *log.mean_speed;
    trajectory.loss_velocity = *log.loss_velocity;
  }
  if (bristle == BristleStart::torque) trajectory.torque = log.torque;
  trajectory.starts = log.further_starts;
  return trajectory;
}

Prediction PredictFriction(const Friction& friction, const LogSamples& log,
                           const ThermalStart& start, BristleStart bristle) {
  return AlongMotion(friction).Predict(TrajectoryOf(log, bristle), start);
}

}  // namespace warmjoint
