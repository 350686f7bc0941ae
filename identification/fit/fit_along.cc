#include "identification/fit/fit_along.h"

namespace warmjoint {

FollowedBy PartsOf(const Fit& fit) {
  const bool grows = fit.RowOf(Role::load) && fit.model.gravity;
  return {grows ? &*fit.model.gravity : nullptr, fit.model.delay};
}

Eigen::VectorXd TorqueAlong(const Fit& fit, const LogSamples& m) {
  Eigen::VectorXd torque = PredictFriction(fit.model.friction, m, fit.Start()).force;
  if (fit.model.gravity) torque += fit.model.gravity->Torque(m.position);
  if (fit.model.inertia && m.acceleration) torque += *fit.model.inertia * *m.acceleration;
  return torque;
}

}  // namespace warmjoint
