#include "identification/lack_of_fit/held_loss.h"

#include <algorithm>
#include <cmath>

#include "identification/forward/log_course.h"
#include "models/friction/along_motion.h"

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr Index kOfEachStep = 8;   // of each step
constexpr double kMatters = 0.25;  // of tau's deviation; why: it costs 0.7 % of the coverage

/// Each value for each part of its sample; empty stays empty. column: [N]; returns [N kOfEachStep].
Eigen::VectorXd Repeated(const Eigen::VectorXd& column) {
  return column.transpose().replicate(column.size() > 0 ? kOfEachStep : 1, 1).reshaped();
}

/// The same motion with kOfEachStep samples for each, at its speed throughout. [N kOfEachStep]
JointCourse Finer(const JointCourse& course, double gear) {
  const Index n = course.time.size();
  // a sample lasts until the next one, the last as long as the one before it
  Eigen::VectorXd since(n * kOfEachStep);  // s, since the sample
  for (Index i = 0; i < n; ++i) {
    const Index step = std::min(i, n - 2);
    const double h = course.time[step + 1] - course.time[step];
    for (Index k = 0; k < kOfEachStep; ++k) {
      since[i * kOfEachStep + k] = h * static_cast<double>(k) / static_cast<double>(kOfEachStep);
    }
  }

  // every column holds over the step, but for time and positions, which go on
  JointCourse finer;
  for (const auto column :
       {&JointCourse::time, &JointCourse::velocity, &JointCourse::position,
        &JointCourse::motor_position, &JointCourse::load, &JointCourse::ambient_rise,
        &JointCourse::level, &JointCourse::torque}) {
    finer.*column = Repeated(course.*column);
  }
  const Eigen::VectorXd way = since.cwiseProduct(finer.velocity);
  finer.time += since;
  if (finer.position.size() > 0) finer.position += way;
  if (finer.motor_position.size() > 0) finer.motor_position += gear * way;
  for (const Index start : course.starts) finer.starts.push_back(start * kOfEachStep);
  return finer;
}

}  // namespace

bool StepMatters(const Fit& fit, const Inference& inference, const Eigen::VectorXd& velocity,
                 double step) {
  if (!fit.friction.thermal) return false;
  const auto tau = fit.RowOf(Role::heat, 1);
  if (!tau || !inference.parameters[*tau].std) return false;
  // by how much tau comes out too large, h |k v|/2
  const double gain = fit.friction.thermal->gain;
  const double power = std::abs(gain) * velocity.cwiseAbs().mean();
  return 0.5 * step * power > kMatters * *inference.parameters[*tau].std;
}

Eigen::VectorXd ForceOfHeldLoss(const Friction& friction, const LogSamples& measurements,
                                const CourseStart& start) {
  const AlongMotion model(friction);
  const JointCourse course = CourseOf(measurements);
  // E jumps at the same moments of the finer course
  CourseStart finer_start = start;
  for (EnergyJump& jump : finer_start.jumps) jump.sample *= kOfEachStep;
  const Eigen::VectorXd fine = model.Predict(Finer(course, measurements.gear), finer_start).force;
  const Eigen::VectorXd held = model.Predict(course, start).force;

  // an eighth of each step leaves an eighth of the error: 8/7 of the difference is all
  Eigen::VectorXd difference(held.size());
  for (Index n = 0; n < held.size(); ++n) difference[n] = fine[n * kOfEachStep] - held[n];
  return difference * static_cast<double>(kOfEachStep) / static_cast<double>(kOfEachStep - 1);
}

}  // namespace warmjoint
