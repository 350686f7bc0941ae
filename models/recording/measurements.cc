#include "models/recording/measurements.h"

#include <algorithm>

namespace warmjoint {

Measurements FirstSamples(Measurements log, Eigen::Index n) {
  ForEachColumn(
      log, [n](Eigen::VectorXd& column) { column.conservativeResize(std::min(n, column.size())); });
  if (log.gaps) std::erase_if(*log.gaps, [n](const LogGap& gap) { return gap.behind >= n; });
  return log;
}

std::vector<LogGap> GapsOf(const Eigen::VectorXd& time) {
  std::vector<LogGap> gaps;
  if (time.size() < 2) return gaps;
  // no step is more than so many times the shortest: none is of the median, which needs no search for that
  const auto steps = time.tail(time.size() - 1) - time.head(time.size() - 1);
  if (steps.maxCoeff() <= kGapSteps * steps.minCoeff()) return gaps;
  const double longest = LongestStep(time);
  for (Eigen::Index n = 1; n < time.size(); ++n) {
    const double length = time[n] - time[n - 1];
    if (length > longest) gaps.push_back({n, length});
  }
  return gaps;
}

JointCourse CourseOf(const Measurements& measurements, BristleStart bristle) {
  const Measurements& m = measurements;
  JointCourse course{m.time, m.velocity, m.position};
  // the motor's own sensor, or the gear
  course.motor_position = MotorPosition(m);
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
