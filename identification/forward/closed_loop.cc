#include "identification/forward/closed_loop.h"

#include <cmath>

#include "identification/forward/closed_loop_kernel.h"
#include "models/friction/sign.h"

namespace warmjoint {

ClosedLoop::ClosedLoop(const Eigen::VectorXd& time, const Eigen::VectorXd& velocity,
                       const Eigen::MatrixXd& columns, const std::vector<Eigen::Index>& starts)
    : speed_(velocity.cwiseAbs()),
      direction_(velocity.unaryExpr([](double v) { return static_cast<double>(Sign(v)); })),
      levels_(direction_.asDiagonal() * columns),
      intervals_(FindIntervals(time, starts)) {}

LoopResponse ClosedLoop::Simulate(const Eigen::VectorXd& parameters, const Thermal& thermal,
                                  double initial_energy) const {
  const Eigen::VectorXd nominal = levels_ * parameters;
  LoopResponse response;
  response.force.resize(size());
  response.loss.resize(size());
  response.energy.resize(size());
  WithHolds(intervals_, thermal, [&](const auto& hold_after) {
    double energy = initial_energy;
    for (Eigen::Index n = 0; n < size(); ++n) {
      const double level = nominal[n] + std::abs(direction_[n]) * energy;
      const ThermalHold& hold = hold_after[n];
      double feedback = hold.gain * speed_[n];
      if (level < 0) {  // W = -|v| a
        if (!response.feeds_itself) response.feeds_itself = n;
        feedback = -feedback;
      }
      response.energy[n] = energy;
      response.force[n] = direction_[n] * level;
      response.loss[n] = Loss(speed_[n], level);
      energy = (hold.pole + feedback) * energy + feedback * nominal[n];
    }
  });
  return response;
}

Eigen::MatrixXd ClosedLoop::Jacobian(const Eigen::VectorXd& parameters, const Thermal& thermal,
                                     double initial_energy) const {
  const Eigen::Index d = levels_.cols();
  Eigen::MatrixXd jacobian(size(), d + 3);
  const auto write = [&](Eigen::Index n, double, const double* g, const double* S) {
    for (Eigen::Index i = 0; i < d; ++i) jacobian(n, i) = direction_[n] * (g[i] + S[i]);
    for (Eigen::Index i = d; i < d + 3; ++i) jacobian(n, i) = direction_[n] * S[i];
  };
  WithHolds(intervals_, thermal, [&](const auto& hold) {
    RunWithSensitivities<Eigen::Dynamic>(*this, parameters.data(), thermal.gain, initial_energy,
                                         hold, write);
  });

  // from log(tau) to tau
  jacobian.col(d + 1) /= thermal.time_constant;
  return jacobian;
}

Eigen::MatrixXd ByDiscretePair(const Eigen::MatrixXd& jacobian, const Thermal& thermal, double h) {
  const Eigen::Index d = jacobian.cols() - 3;
  const DiscreteThermal discrete = Discretise(thermal, h);
  const double cooling = -std::expm1(-h / thermal.time_constant);

  // k = ke / (1 - te), tau = -h / log(te)
  Eigen::MatrixXd result = jacobian;
  result.col(d) = jacobian.col(d) / cooling;
  result.col(d + 1) =
      jacobian.col(d) * (thermal.gain / cooling) +
      jacobian.col(d + 1) * (thermal.time_constant * thermal.time_constant / (h * discrete.pole));
  return result;
}

}  // namespace warmjoint
