#include "identification/fit/fit_along.h"

#include <utility>

#include "models/friction/along_motion.h"

namespace warmjoint {

FollowedBy PartsOf(const Fit& fit) {
  const bool grows = fit.RowOf(Role::load) && fit.model.gravity;
  return {grows ? &*fit.model.gravity : nullptr, fit.model.delay};
}

Prediction FrictionAlong(const Fit& fit, const LogSamples& m) {
  JointTrajectory trajectory = TrajectoryOf(m, BristleStart::torque);
  const std::vector<SampleRange> recordings = m.Recordings();
  for (size_t r = 0; r < fit.start.friction.size(); ++r) {
    trajectory.torque[recordings[r].first] = fit.start.friction[r];
  }
  return AlongMotion(fit.model.friction).Predict(trajectory, fit.Start());
}

Eigen::VectorXd WithRigid(const TorqueModel& model, const LogSamples& m, Eigen::VectorXd friction) {
  if (model.gravity) friction += model.gravity->Torque(m.position);
  if (model.inertia && m.acceleration) friction += *model.inertia * *m.acceleration;
  return friction;
}

Eigen::VectorXd TorqueAlong(const Fit& fit, const LogSamples& m) {
  return WithRigid(fit.model, m, FrictionAlong(fit, m).force);
}

}  // namespace warmjoint
