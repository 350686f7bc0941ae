#include "identification/lack_of_fit/circumstances.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "identification/forward/thermal_filter.h"
#include "identification/linear/rigid_part.h"
#include "models/foundation/four.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

constexpr int kMemories = 6;  // time constants that are tried

/// Means over bins of the measured losses filtered with three time constants that span those of a recording. [m x 3]
WARMJOINT_FOR_EACH_PROCESSOR
Eigen::MatrixXd Energies(const FittedModel& model, const Measurements& m, const Bins& bins,
                         const ThermalFilter& filter) {
  const double duration = m.time[m.size() - 1] - m.time[0];
  const Eigen::VectorXd loss = model.torque.cwiseProduct(m.velocity).cwiseAbs();
  const Fours<1> times{Four{duration / 40, duration / 12, duration / 3, duration}};
  return MeansOfRows<1>(bins, filter.Together(times, loss, 0)).leftCols(3);
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

/// Time constants of a memory, from half a hold to an eighth of the log, the same ratio apart. s
std::vector<double> MemoryTimes(double hold, double duration) {
  const double shortest = 0.5 * hold, longest = duration / 8;
  std::vector<double> times;
  if (!(hold > 0) || !(longest > shortest)) return times;
  const double ratio = std::pow(longest / shortest, 1.0 / (kMemories - 1));
  for (int i = 0; i < kMemories; ++i) times.push_back(shortest * std::pow(ratio, i));
  return times;
}

/// Means over bins of |v| behind filters of first order, which begin at the first speed, less |v|. [m x times]
WARMJOINT_FOR_EACH_PROCESSOR
Eigen::MatrixXd LateSpeeds(const Measurements& m, const std::vector<double>& times,
                           const Bins& bins, const ThermalFilter& filter) {
  if (times.empty()) return Eigen::MatrixXd(bins.size(), 0);
  const Eigen::VectorXd speed = m.velocity.cwiseAbs();
  static_assert(kMemories <= 8);
  Fours<2> all;
  for (int i = 0; i < 8; ++i) all[i / 4][i % 4] = times[std::min(i, kMemories - 1)];
  const Eigen::MatrixXd late = MeansOfRows<2>(bins, filter.Together(all, speed, speed[0]));
  return late.leftCols(kMemories).colwise() - bins.Means(speed).col(0);
}

}  // namespace

Circumstances CircumstancesOf(const FittedModel& model, const Measurements& m, const Bins& bins) {
  const Eigen::MatrixXd none(bins.size(), 0);
  Circumstances known;
  known.torque = bins.Means(model.torque);
  known.residual = bins.Means(model.residual);
  const ThermalFilter filter(m.time, m.starts);
  known.energies = Energies(model, m, bins, filter);
  known.initial = known.loads = known.temperatures = none;

  // forces with the heat that they make themselves, a slope that warms among them
  known.heating = HeatingForcesOf(model, m, bins);

  // the start where it is taken to be known, load and temperature where they are logged
  if (model.by_initial_energy) known.initial = bins.Means(*model.by_initial_energy);
  if (m.load) known.loads = bins.Means(ConcatColumns(*m.load, m.load->cwiseAbs()));
  if (m.temperature) known.temperatures = bins.Means(*m.temperature);

  // friction that follows the speed late, by half a hold to an eighth of the log
  known.duration = m.time[m.size() - 1] - m.time[0];
  known.hold = MedianHold(model, m);
  known.past = MemoryTimes(known.hold, known.duration);
  const Eigen::VectorXd sign = bins.velocity.array().sign();
  known.late_speeds = sign.asDiagonal() * LateSpeeds(m, known.past, bins, filter);
  return known;
}

}  // namespace warmjoint
