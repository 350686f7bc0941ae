// The thermal filter over a recording, Eq. (22), with its derivatives by the time constant.
#pragma once

#include <Eigen/Core>
#include <array>
#include <utility>
#include <vector>

#include "models/friction/thermal.h"

namespace warmjoint::inline identification {

/// E at unit gain and its derivatives by ln tau, in J; the filter is linear in its gain.
struct UnitEnergy {
  double value = 0;
  double slope = 0;
  double curvature = 0;

  /// The state one step later. loss: W during the step, W.
  UnitEnergy After(const ThermalHold<>& hold, double loss) const {
    const double distance = value - loss;
    return {hold.After(value, loss), hold.pole * slope + hold.Slope() * distance,
            hold.pole * curvature + 2 * hold.Slope() * slope + hold.Curvature() * distance};
  }
};

/// Filters losses through H = gain / (1 + s tau) at the sample times of a recording. Between two
/// samples the loss holds the value that it had at the first.
class ThermalFilter {
 public:
  /// time: [N] s, strictly increasing. Steps that differ by less than 1e-6 of their mean count as
  /// even, which saves an exponential a sample. starts: samples at which the joint is cold again.
  explicit ThermalFilter(const Eigen::VectorXd& time, std::vector<Eigen::Index> starts = {});

  Eigen::Index size() const { return steps_.size() + 1; }
  /// Mean step, s.
  double mean_step() const { return mean_step_; }

  /// E over all samples, N.m or N, from E(0) = initial. loss: [N] W; returns [N].
  Eigen::VectorXd Energy(const Thermal& thermal, const Eigen::VectorXd& loss,
                         double initial = 0) const;

  /// Calls visit(i, E) for each sample i with E at unit gain for several time constants, s: E [1 x C].
  template <std::size_t C, typename Visit>
  void ForEach(const std::array<double, C>& time_constants, const Eigen::VectorXd& loss,
               double initial, Visit visit) const;

  /// The transpose of that linear map, from weights of E to weights of the loss: u . Energy(W) =
  /// Transposed(u) . W. Runs back in time, l[i] = u[i] + te l[i+1], and gives gain (1 - te) l[i+1].
  /// weights: [N] u; returns [N].
  Eigen::VectorXd Transposed(const Thermal& thermal, const Eigen::VectorXd& weights) const;

  /// Calls visit(i, UnitEnergy) for each sample i, from a state of 0. loss: [N] W.
  template <typename Visit>
  void ForEach(double time_constant, const Eigen::VectorXd& loss, Visit visit) const;

 private:
  /// Whether sample i is the next start; counts on in `next`.
  bool Starts(Eigen::Index i, size_t& next) const {
    if (next == starts_.size() || starts_[next] != i) return false;
    ++next;
    return true;
  }

  Eigen::VectorXd steps_;  // [N - 1] s
  std::vector<Eigen::Index> starts_;
  double mean_step_ = 0;  // s
  bool even_ = false;
};

template <std::size_t C, typename Visit>
void ThermalFilter::ForEach(const std::array<double, C>& time_constants,
                            const Eigen::VectorXd& loss, double initial, Visit visit) const {
  using Row = Eigen::Matrix<double, 1, static_cast<int>(C)>;
  Row energies = Row::Constant(initial), poles, coolings;
  const auto hold_over = [&](double step) {
    for (std::size_t k = 0; k < C; ++k) {
      const ThermalHold<> hold = HoldOver(step, time_constants[k]);
      poles[static_cast<Eigen::Index>(k)] = hold.pole;
      coolings[static_cast<Eigen::Index>(k)] = hold.cooling;
    }
  };
  visit(Eigen::Index{0}, energies);

  // all of them a sample further, so that none waits for its own sample before
  hold_over(mean_step_);
  size_t next = 0;
  for (Eigen::Index i = 0; i < steps_.size(); ++i) {
    if (!even_) hold_over(steps_[i]);
    energies = poles.cwiseProduct(energies) + coolings * loss[i];
    // another recording starts cold
    if (Starts(i + 1, next)) energies.setZero();
    visit(i + 1, energies);
  }
}

template <typename Visit>
void ThermalFilter::ForEach(double time_constant, const Eigen::VectorXd& loss, Visit visit) const {
  UnitEnergy energy;
  size_t next = 0;
  visit(Eigen::Index{0}, energy);

  const ThermalHold<> mean = HoldOver(mean_step_, time_constant);
  for (Eigen::Index i = 0; i < steps_.size(); ++i) {
    energy = energy.After(even_ ? mean : HoldOver(steps_[i], time_constant), loss[i]);
    if (Starts(i + 1, next)) energy = {};
    visit(i + 1, energy);
  }
}

}  // namespace warmjoint::inline identification
