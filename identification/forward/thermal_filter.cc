#include "identification/forward/thermal_filter.h"

#include <algorithm>

namespace warmjoint {

ThermalFilter::ThermalFilter(const Eigen::VectorXd& time, std::vector<Eigen::Index> starts)
    : starts_(std::move(starts)) {
  const Eigen::Index count = time.size() - 1;
  steps_ = time.tail(count) - time.head(count);
  mean_step_ = (time[count] - time[0]) / static_cast<double>(count);
  even_ = ((steps_.array() - mean_step_).abs() < 1e-6 * mean_step_).all();
}

Eigen::VectorXd ThermalFilter::Energy(const Thermal& thermal, const Eigen::VectorXd& loss,
                                      double initial) const {
  Eigen::VectorXd energy(size());
  energy[0] = initial;
  size_t next = 0;
  // the hold of an even log is the same for all steps
  const ThermalHold<> mean = HoldOver(mean_step_, thermal.time_constant);
  for (Eigen::Index i = 0; i < steps_.size(); ++i) {
    const ThermalHold<> hold = even_ ? mean : HoldOver(steps_[i], thermal.time_constant);
    energy[i + 1] = ThermalStep(thermal.gain * hold.cooling, hold.pole, energy[i], loss[i]);
    // another recording starts cold
    if (Starts(i + 1, next)) energy[i + 1] = 0;
  }
  return energy;
}

Eigen::VectorXd ThermalFilter::Transposed(const Thermal& thermal,
                                          const Eigen::VectorXd& weights) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(size());
  // backwards in time, since a loss adds to E at all later samples
  const ThermalHold<> mean = HoldOver(mean_step_, thermal.time_constant);
  double later = 0;  // the weight of E at sample i + 1, with all that follows from it
  for (Eigen::Index i = steps_.size() - 1; i >= 0; --i) {
    const ThermalHold<> hold = even_ ? mean : HoldOver(steps_[i], thermal.time_constant);
    later = weights[i + 1] + later;
    if (std::binary_search(starts_.begin(), starts_.end(), i + 1)) later = 0;
    result[i] = thermal.gain * hold.cooling * later;
    later *= hold.pole;
  }
  return result;
}

}  // namespace warmjoint
