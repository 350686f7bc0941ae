#include "identification/lack_of_fit/circumstances.h"

#include <array>
#include <vector>

#include "identification/forward/thermal_filter.h"
#include "identification/lack_of_fit/with_heat.h"
#include "identification/linear/rigid_part.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint::inline identification {
namespace {

/// The measured losses filtered with three time constants that span those of a recording. [N x 3]
Eigen::MatrixXd Energies(const FittedModel& model, const Measurements& m) {
  const double duration = m.time[m.size() - 1] - m.time[0];
  const Eigen::VectorXd loss = model.torque.cwiseProduct(m.velocity).cwiseAbs();
  const ThermalFilter filter(m.time, m.starts);
  Eigen::MatrixXd energies(m.size(), 3);
  for (int i = 0; i < 3; ++i) {
    energies.col(i) = filter.Energy({1, duration / std::array{40.0, 12.0, 3.0}[i]}, loss);
  }
  return energies;
}

/// Median duration of the segments; 0 where there are none.
double MedianHold(const FittedModel& model, const Measurements& m) {
  const std::vector<Segment>& segments = model.selection.segments;
  Eigen::VectorXd durations(static_cast<Eigen::Index>(segments.size()));
  for (size_t i = 0; i < segments.size(); ++i) {
    durations[static_cast<Eigen::Index>(i)] =
        m.time[segments[i].end - 1] - m.time[segments[i].begin];
  }
  return durations.size() > 0 ? MedianInPlace(durations) : 0;
}

}  // namespace

Circumstances CircumstancesOf(const FittedModel& model, const Measurements& m, const Bins& bins) {
  const Eigen::MatrixXd none(bins.size(), 0);
  Circumstances known{bins.Means(Energies(model, m)), none, none, none, none};
  if (model.thermal) {
    const Eigen::VectorXd slope = m.velocity.cwiseProduct(model.energy);
    const Eigen::VectorXd at_losses =
        m.loss_velocity.value_or(m.velocity).cwiseProduct(model.energy);
    known.slopes = bins.Means(WithHeat(model, m, slope, at_losses));
  }
  if (model.by_initial_energy) known.initial = bins.Means(*model.by_initial_energy);
  if (m.load) known.loads = bins.Means(Beside(*m.load, m.load->cwiseAbs()));
  if (m.temperature) known.temperatures = bins.Means(*m.temperature);
  known.duration = m.time[m.size() - 1] - m.time[0];
  known.hold = MedianHold(model, m);
  return known;
}

}  // namespace warmjoint::inline identification
