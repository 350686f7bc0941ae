#include "identification/online/measured_heat.h"

namespace warmjoint {

MeasuredHeat::MeasuredHeat(const Measurements& measurements, const Thermal& thermal)
    : thermal_(thermal),
      filter_(measurements.time, measurements.starts),
      velocity_(measurements.velocity),
      direction_(measurements.velocity.array().sign()) {}

Eigen::MatrixXd MeasuredHeat::TakenOff(const Eigen::MatrixXd& columns) const {
  Eigen::MatrixXd result = columns;
  for (Eigen::Index j = 0; j < columns.cols(); ++j) {
    // the loss that the column stands for, and the energy that it leaves
    const Eigen::VectorXd loss = velocity_.cwiseProduct(columns.col(j));
    result.col(j) -= direction_.cwiseProduct(filter_.Energy(thermal_, loss));
  }
  return result;
}

Eigen::MatrixXd MeasuredHeat::Transposed(const Eigen::MatrixXd& columns) const {
  Eigen::MatrixXd result = columns;
  for (Eigen::Index j = 0; j < columns.cols(); ++j) {
    // the same three steps, each transposed, in reverse order
    const Eigen::VectorXd weights = direction_.cwiseProduct(columns.col(j));
    result.col(j) -= velocity_.cwiseProduct(filter_.Transposed(thermal_, weights));
  }
  return result;
}

}  // namespace warmjoint
