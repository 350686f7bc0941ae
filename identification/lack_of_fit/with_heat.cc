#include "identification/lack_of_fit/with_heat.h"

#include "identification/forward/closed_loop.h"

namespace warmjoint::inline identification {

Eigen::MatrixXd WithHeat(const FittedModel& model, const Measurements& m,
                         const Eigen::MatrixXd& forces, const Eigen::MatrixXd& at_losses) {
  if (!model.thermal) return forces;
  const ClosedLoop loop =
      model.loop->WithColumns(forces, m.loss_velocity ? at_losses : Eigen::MatrixXd());
  // by a force's own factor the loop is linear: its derivative is the same wherever the others are
  return loop.LawJacobian(*model.thermal);
}

}  // namespace warmjoint::inline identification
