// The thermal filter over a recording, Eq. (22), with its derivatives by the time constant.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "models/foundation/four.h"
#include "models/friction/thermal.h"

namespace warmjoint {

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

  /// E over all samples, N.m or N, from E(0) = initial. loss: [N] W; returns [N].
  Eigen::VectorXd Energy(const Thermal& thermal, const Eigen::VectorXd& loss,
                         double initial = 0) const;

  /// E at unit gain for 4 F time constants, s, from E(0) = initial: a function of sample n that writes them, to be called for
  /// one sample after the other from the first on. It refers to the filter and to the loss.
  template <std::size_t F>
  auto Together(const Fours<F>& time_constants, const Eigen::VectorXd& loss, double initial) const;

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

template <std::size_t F>
inline auto ThermalFilter::Together(const Fours<F>& time_constants, const Eigen::VectorXd& loss,
                                    double initial) const {
  // the hold of an even log is the same for all steps
  Fours<F> energies, poles, coolings;
  for (Four& four : energies) four = Four{initial, initial, initial, initial};
  const auto hold_over = [time_constants](double step, Fours<F>& pole, Fours<F>& cooling) {
    for (std::size_t k = 0; k < F; ++k) {
      for (int i = 0; i < 4; ++i) {
        const ThermalHold<> hold = HoldOver(step, time_constants[k][i]);
        pole[k][i] = hold.pole;
        cooling[k][i] = hold.cooling;
      }
    }
  };
  hold_over(mean_step_, poles, coolings);
  return [this, &loss, hold_over, energies, poles, coolings, next = size_t{0}](
             Eigen::Index n, Fours<F>& now) mutable {
    now = energies;
    if (n + 1 == size()) return;
    // all of them a sample further, so that none waits for its own sample before
    if (!even_) hold_over(steps_[n], poles, coolings);
    for (std::size_t k = 0; k < F; ++k)
      energies[k] = poles[k] * energies[k] + coolings[k] * loss[n];
    // another recording starts cold
    if (Starts(n + 1, next)) energies = {};
  };
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

}  // namespace warmjoint
