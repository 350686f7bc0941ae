#include "identification/alternating/block_descent.h"

#include <cmath>

namespace warmjoint {

BlockDescent::BlockDescent(const Measurements& measurements, const Selection& moving,
                           const Eigen::MatrixXd& columns, const Eigen::MatrixXd& cofactor,
                           const Eigen::VectorXd& gravity)
    : cofactor_(cofactor),
      // (19) with the measured torque
      output_error_(measurements.time,
                    (measurements.torque - gravity).cwiseProduct(measurements.velocity).cwiseAbs(),
                    moving, measurements.starts),
      kept_(static_cast<double>(moving.count())) {
  const Eigen::VectorXd keep = moving.keep.cast<double>();
  const Eigen::VectorXd& v = measurements.velocity;
  sign_ = keep.cwiseProduct(v.unaryExpr([](double x) { return static_cast<double>(Sign(x)); }));
  torque_ = keep.cwiseProduct(measurements.torque);
  columns_ = keep.asDiagonal() * columns;
}

DescentState BlockDescent::Start(const Thermal& start) const { return WithNominal(start, true); }

DescentState BlockDescent::Next(const DescentState& state) const {
  const OutputError::Fit fit =
      output_error_.Refine(MeasuredEnergy(state.nominal), state.thermal.time_constant);
  return WithNominal(fit.thermal, fit.inside);
}

double BlockDescent::ScanFrom(const DescentState& state) const {
  return output_error_.Scan(MeasuredEnergy(state.nominal));
}

Eigen::VectorXd BlockDescent::Warming(const Thermal& thermal) const {
  return sign_.cwiseProduct(output_error_.filter().Energy(thermal, output_error_.loss()));
}

Eigen::VectorXd BlockDescent::Fitted(const DescentState& state) const {
  return columns_ * state.nominal + Warming(state.thermal);
}

Eigen::MatrixXd BlockDescent::Jacobian(const DescentState& state) const {
  const Eigen::Index d = columns_.cols();
  Eigen::MatrixXd jacobian(columns_.rows(), d + 2);
  jacobian.leftCols(d) = columns_;
  // the heat is linear in the gain; the time constant stands by its logarithm
  const auto& [gain, time_constant] = state.thermal;
  output_error_.filter().ForEach(time_constant, output_error_.loss(),
                                 [&](Eigen::Index i, const UnitEnergy& energy) {
                                   jacobian(i, d) = sign_[i] * energy.value;
                                   jacobian(i, d + 1) = sign_[i] * gain * energy.slope;
                                 });
  return jacobian;
}

// E = (tau - Fn) sign(v), Eq. (23)
Eigen::VectorXd BlockDescent::MeasuredEnergy(const Eigen::VectorXd& nominal) const {
  return sign_.cwiseProduct(torque_ - columns_ * nominal);
}

// Fn = tau - sign(v) E, Eq. (24), by least squares
DescentState BlockDescent::WithNominal(const Thermal& thermal, bool inside) const {
  const Eigen::VectorXd target = torque_ - Warming(thermal);
  DescentState state;
  state.nominal = cofactor_ * (columns_.transpose() * target);
  state.thermal = thermal;
  state.rmse = (target - columns_ * state.nominal).norm() / std::sqrt(kept_);
  state.inside = inside;
  return state;
}

}  // namespace warmjoint
