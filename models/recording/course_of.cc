#include "models/recording/course_of.h"

namespace warmjoint {

JointCourse CourseOf(const Measurements& measurements, BristleStart bristle) {
  const Measurements& m = measurements;
  JointCourse course{m.time, m.velocity, m.position};
  // the motor's own sensor, or the gear
  course.motor_position = m.motor_position.value_or(m.gear * m.position);
  // what the log has beside its motion
  if (m.load) course.load = *m.load;
  if (m.mean_speed && m.loss_velocity) {
    course.mean_speed = *m.mean_speed;
    course.loss_velocity = *m.loss_velocity;
  }
  if (bristle == BristleStart::torque) course.torque = m.torque;
  course.starts = m.starts;
  return course;
}

Prediction PredictFriction(const Friction& friction, const Measurements& measurements,
                           const CourseStart& start, BristleStart bristle) {
  return AlongMotion(friction).Predict(CourseOf(measurements, bristle), start);
}

}  // namespace warmjoint
