#include "identification/forward/closed_loop.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "identification/forward/closed_loop_kernel.h"
#include "models/foundation/four.h"
#include "models/friction/sign.h"

namespace warmjoint {
namespace {

/// Calls run(D) with the number of law parameters where the compiler may know it, or Dynamic.
template <typename Run>
void WithLoopSize(const ClosedLoop& loop, Run&& run) {
  // most laws have two levels, which then stay in registers
  if (loop.levels().cols() == 2 && loop.jumps().empty()) {
    run(std::integral_constant<int, 2>());
  } else {
    run(std::integral_constant<int, Eigen::Dynamic>());
  }
}

/// dF/d(p, k, log tau, E0, jumps): [N x (d + 3 + J)]
WARMJOINT_FOR_EACH_PROCESSOR
Eigen::MatrixXd ForceSlopes(const ClosedLoop& loop, const Eigen::VectorXd& parameters,
                            const Thermal& thermal, double initial_energy,
                            const Eigen::VectorXd& jumps) {
  const Eigen::Index d = loop.levels().cols();
  const Eigen::Index all = d + 3 + static_cast<Eigen::Index>(loop.jumps().size());
  Eigen::MatrixXd slopes(loop.size(), all);
  WithLoopSize(loop, [&]<int D>(std::integral_constant<int, D>) {
    const Eigen::Index own = LoopSize<D>(d), count = D == Eigen::Dynamic ? all : D + 3;
    // levels become torques by the direction of motion
    const Eigen::VectorXd& direction = loop.direction();
    const auto write = [&](Eigen::Index n, double, const double* g, const double* S) {
      for (Eigen::Index i = 0; i < own; ++i) slopes(n, i) = direction[n] * (g[i] + S[i]);
      for (Eigen::Index i = own; i < count; ++i) slopes(n, i) = direction[n] * S[i];
    };
    WithHolds(loop.intervals(), thermal, [&](const auto& hold) {
      RunWithSensitivities<D>(loop, parameters.data(), thermal.gain, initial_energy, jumps.data(),
                              hold, write);
    });
  });
  return slopes;
}

/// The same along a stretch, of levels that are not those of the loop. at: where it begins and ends
WARMJOINT_FOR_EACH_PROCESSOR
ClosedLoop::Rows SlopesOfStretch(const ClosedLoop& loop, const LoopStretch& stretch,
                                 const Eigen::VectorXd& parameters, const Thermal& thermal,
                                 const Eigen::VectorXd& jumps, LoopEnd& at) {
  ClosedLoop::Rows slopes(stretch.last - stretch.first, at.slopes.size());
  const auto write = [&](Eigen::Index n, double, const double* g, const double* S) {
    const double direction = loop.direction()[n];
    double* row = slopes.data() + (n - stretch.first) * slopes.cols();
    for (Eigen::Index i = 0; i < stretch.d; ++i) row[i] = direction * (g[i] + S[i]);
    for (Eigen::Index i = stretch.d; i < slopes.cols(); ++i) row[i] = direction * S[i];
  };
  Sensitivities<Eigen::Dynamic> S(at.slopes.begin(), at.slopes.end());
  WithHolds(loop.intervals(), thermal, [&](const auto& hold) {
    RunAlong<Eigen::Dynamic>(loop, stretch, parameters.data(), thermal.gain, jumps.data(), hold,
                             at.energy, S, write);
  });
  at.slopes = Eigen::Map<const Eigen::VectorXd>(S.data(), at.slopes.size());
  return slopes;
}

}  // namespace

ClosedLoop::ClosedLoop(const Eigen::VectorXd& time, const Eigen::VectorXd& velocity,
                       const Eigen::MatrixXd& columns, const std::vector<Eigen::Index>& starts)
    : speed_(velocity.cwiseAbs()),
      direction_(velocity.size()),
      intervals_(FindIntervals(time, starts)) {
  for (Eigen::Index n = 0; n < size(); ++n) direction_[n] = Sign(velocity[n]);
  levels_ = Signed(columns);
}

/// Columns times the direction of motion, a sample after the other, from the first on. [m x d]
ClosedLoop::Rows ClosedLoop::Signed(const Eigen::MatrixXd& columns, Eigen::Index first) const {
  Rows rows(columns.rows(), columns.cols());
  // rows that stay in the cache while a column after the other is read as it lies
  constexpr Eigen::Index kTile = 64;
  for (Eigen::Index begin = 0; begin < rows.rows(); begin += kTile) {
    const Eigen::Index end = std::min(begin + kTile, rows.rows());
    for (Eigen::Index i = 0; i < rows.cols(); ++i) {
      const double* column = columns.col(i).data();
      double* to = rows.data() + begin * rows.cols() + i;
      for (Eigen::Index n = begin; n < end; ++n, to += rows.cols())
        *to = direction_[first + n] * column[n];
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
                                  double initial_energy, const Eigen::VectorXd& jumps) const {
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
      if (next < jumps_.size() && jumps_[next] == n)
        energy += jumps[static_cast<Eigen::Index>(next++)];
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

Eigen::MatrixXd ClosedLoop::Jacobian(const Eigen::VectorXd& parameters, const Thermal& thermal,
                                     double initial_energy, const Eigen::VectorXd& jumps) const {
  Eigen::MatrixXd jacobian = ForceSlopes(*this, parameters, thermal, initial_energy, jumps);

  // from log(tau) to tau
  jacobian.col(levels_.cols() + 1) /= thermal.time_constant;
  return jacobian;
}

ClosedLoop::Rows ClosedLoop::SlopesAlong(const LoopColumns& columns,
                                         const Eigen::VectorXd& parameters, const Thermal& thermal,
                                         const Eigen::VectorXd& jumps, LoopEnd& at) const {
  const Rows levels = Signed(columns.law, columns.first);
  const Rows of_loss = columns.loss.size() > 0 ? Signed(columns.loss, columns.first) : Rows();
  const LoopStretch stretch{columns.first, columns.first + levels.rows(), levels.data(),
                            of_loss.size() > 0 ? of_loss.data() : levels.data(), levels.cols()};
  return SlopesOfStretch(*this, stretch, parameters, thermal, jumps, at);
}

LoopEnd ClosedLoop::End(const Eigen::VectorXd& parameters, const Thermal& thermal,
                        double initial_energy, const Eigen::VectorXd& jumps) const {
  const Eigen::Index all = levels_.cols() + 3 + static_cast<Eigen::Index>(jumps_.size());
  LoopEnd end{initial_energy, Eigen::VectorXd::Zero(all)};
  const auto take_last = [&](Eigen::Index n, double level, const double*, const double* S) {
    if (n + 1 < size()) return;
    end.energy = level - levels_.row(n).dot(parameters);
    end.slopes = Eigen::Map<const Eigen::VectorXd>(S, all);
  };
  WithLoopSize(*this, [&]<int D>(std::integral_constant<int, D>) {
    WithHolds(intervals_, thermal, [&](const auto& hold) {
      RunWithSensitivities<D>(*this, parameters.data(), thermal.gain, initial_energy, jumps.data(),
                              hold, take_last);
    });
  });
  return end;
}

ClosedLoop ClosedLoop::WithJumps(std::vector<Eigen::Index> samples) const {
  ClosedLoop loop = *this;
  loop.jumps_ = std::move(samples);
  return loop;
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
