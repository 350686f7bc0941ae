#include "identification/fit/fit_along.h"

namespace warmjoint {

FollowedBy PartsOf(const Fit& fit) {
  const bool grows = fit.RowOf(Role::load) && fit.gravity;
  return {grows ? &*fit.gravity : nullptr, fit.torque_delay};
}

Eigen::VectorXd TorqueAlong(const Fit& fit, const LogSamples& m) {
  Eigen::VectorXd torque = PredictFriction(fit.friction, m, fit.Start()).force;
  if (fit.gravity) torque += fit.gravity->Torque(m.position);
  if (fit.inertia && m.acceleration) torque += *fit.inertia * *m.acceleration;
  return torque;
}

}  // namespace warmjoint
