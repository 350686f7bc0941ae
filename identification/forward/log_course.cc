#include "identification/forward/log_course.h"

#include "models/friction/along_motion.h"
#include "models/recording/measurements.h"

namespace warmjoint {

JointCourse CourseOf(const LogSamples& log, BristleStart bristle) {
  JointCourse course{log.time, log.velocity, log.position};
  // the motor's own sensor, or the gear
  course.motor_position = MotorPosition(log);
  // what the log has beside its motion
  if (log.load) course.load = *log.load;
  if (log.mean_speed && log.loss_velocity) {
    course.mean_speed = *log.mean_speed;
    course.loss_velocity = *log.loss_velocity;
  }
  if (bristle == BristleStart::torque) course.torque = log.torque;
  course.starts = log.further_starts;
  return course;
}

Prediction PredictFriction(const Friction& friction, const LogSamples& log,
                           const CourseStart& start, BristleStart bristle) {
  return AlongMotion(friction).Predict(CourseOf(log, bristle), start);
}

}  // namespace warmjoint
