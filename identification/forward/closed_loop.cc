#include "identification/forward/closed_loop.h"

#include <algorithm>
#include <cmath>

#include "identification/forward/holds.h"
#include "models/friction/sign.h"

namespace warmjoint {
ClosedLoop::ClosedLoop(const Eigen::VectorXd& time, const Eigen::VectorXd& velocity,
                       const Eigen::MatrixXd& columns, const std::vector<Eigen::Index>& starts)
    : speed_(velocity.cwiseAbs()),
      direction_(velocity.size()),
      intervals_(FindIntervals(time, starts)) {
  for (Eigen::Index n = 0; n < size(); ++n) direction_[n] = Sign(velocity[n]);
  levels_ = Signed(columns);
}

/// Columns times the direction of motion, a sample after the other. [N x d]
ClosedLoop::Rows ClosedLoop::Signed(const Eigen::MatrixXd& columns) const {
  Rows rows(columns.rows(), columns.cols());
  // rows that stay in the cache while a column after the other is read as it lies
  constexpr Eigen::Index kTile = 64;
  for (Eigen::Index begin = 0; begin < rows.rows(); begin += kTile) {
    const Eigen::Index end = std::min(begin + kTile, rows.rows());
    for (Eigen::Index i = 0; i < rows.cols(); ++i) {
      const double* column = columns.col(i).data();
      double* to = rows.data() + begin * rows.cols() + i;
      for (Eigen::Index n = begin; n < end; ++n, to += rows.cols()) *to = direction_[n] * column[n];
    }
  }
  return rows;
}

ClosedLoop ClosedLoop::Along(const LogSamples& m, const Eigen::MatrixXd& columns,
                             const Eigen::MatrixXd& loss_columns) {
  ClosedLoop loop(m.time, m.velocity, columns, m.further_starts);
  if (m.mean_speed) loop.speed_ = *m.mean_speed;
  if (loss_columns.size() > 0) loop.loss_levels_ = loop.Signed(loss_columns);
  return loop;
}

LoopResponse ClosedLoop::Simulate(const Eigen::VectorXd& parameters, const Thermal& thermal,
                                  double initial_energy, const EnergyJumps& jumps) const {
  // level without heat, and that of the losses where it differs
  const Eigen::VectorXd nominal = levels_ * parameters;
  const Eigen::VectorXd nominal_of_loss =
      loss_levels_.size() > 0 ? Eigen::VectorXd(loss_levels_ * parameters) : nominal;
  // force, losses and energy of each sample
  LoopResponse response;
  response.force.resize(size());
  response.loss.resize(size());
  response.energy.resize(size());
  WithHolds(intervals_, thermal, [&](const auto& hold_after) {
    double energy = initial_energy;
    size_t next = 0;
    for (Eigen::Index n = 0; n < size(); ++n) {
      // a jump represents the losses in a gap, which were not logged
      if (next < jumps.samples.size() && jumps.samples[next] == n)
        energy += jumps.values[static_cast<Eigen::Index>(next++)];
      const double level = nominal[n] + std::abs(direction_[n]) * energy;
      const IntervalHold& hold = hold_after(n);
      const bool pushes = level < 0;  // then W = -|v| a
      if (pushes && !response.first_driving) response.first_driving = n;
      // during the interval E feeds back on its own losses
      const auto [feedback, lambda] = FedBack(hold, pushes ? -speed_[n] : speed_[n]);
      response.energy[n] = energy;
      response.force[n] = direction_[n] * level;
      response.loss[n] = Loss(speed_[n], level + (nominal_of_loss[n] - nominal[n]));
      energy = ThermalStep(feedback, lambda, energy, nominal_of_loss[n]);
    }
  });
  return response;
}

Eigen::MatrixXd ByDiscretePair(const Eigen::MatrixXd& jacobian, const Thermal& thermal, double h) {
  const Eigen::Index d = jacobian.cols() - 3;
  const ThermalHold<> hold = HoldOver(h, thermal.time_constant);

  // k = ke / (1 - te), tau = -h / log(te)
  Eigen::MatrixXd result = jacobian;
  result.col(d) = jacobian.col(d) / hold.cooling;
  result.col(d + 1) =
      jacobian.col(d) * (thermal.gain / hold.cooling) +
      jacobian.col(d + 1) * (thermal.time_constant * thermal.time_constant / (h * hold.pole));
  return result;
}

}  // namespace warmjoint
