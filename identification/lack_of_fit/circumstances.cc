#include "identification/lack_of_fit/circumstances.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "identification/forward/holds.h"
#include "identification/forward/thermal_filter.h"
#include "identification/lack_of_fit/bins.h"
#include "identification/lack_of_fit/fitted_model.h"
#include "identification/linear/rigid_part.h"
#include "models/foundation/four.h"
#include "models/foundation/robust_noise.h"
#include "models/friction/sign.h"

namespace warmjoint {
namespace {

/// dF/dc at c = 0 of frictions that have c s g in addition to the fit's, s = sign(v): s g itself, and what its losses change of
/// E (closed_loop.h); s g alone where no warming was estimated. levels(n, g): makes g of sample n, 4 F numbers in N.m or N;
/// at_losses(n, g): makes of it the same at the velocity of the losses. Returns means over bins, [m x 4 F]. Part of a
/// function for each processor (four.h).
template <std::size_t F, typename Levels, typename AtLosses>
inline Eigen::MatrixXd WithHeat(const FittedModel& model, const Eigen::VectorXd& velocity,
                                const Bins& bins, const Levels& levels, const AtLosses& at_losses) {
  if (!model.thermal) {
    return MeansOfRows<F>(bins, [&](Eigen::Index n, Fours<F>& row) {
      levels(n, row);
      for (Four& four : row) four *= static_cast<double>(Sign(velocity[n]));
    });
  }
  // the loop is linear in a force's own factor, so its derivative does not depend on that factor
  const ClosedLoop& loop = *model.loop;
  Eigen::MatrixXd means;
  WithHolds(loop.intervals(), *model.thermal, [&](const auto& hold_after) {
    Fours<F> S{};  // dE/dc
    means = MeansOfRows<F>(bins, [&](Eigen::Index n, Fours<F>& row) {
      Fours<F> g;
      levels(n, g);
      const double direction = loop.direction()[n];
      for (std::size_t k = 0; k < F; ++k) row[k] = direction * (g[k] + S[k]);
      // one step of Eq. (22); at rest nothing is lost
      at_losses(n, g);
      const auto [feedback, lambda] = FedBack(hold_after(n), loop.speed()[n]);
      const double gain = feedback * std::abs(direction);
      for (std::size_t k = 0; k < F; ++k) S[k] = lambda * S[k] + gain * g[k];
    });
  });
  return means;
}

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;

// why: a drift that takes half the log to die away is still nearly linear, one that takes an eighth is over before the
// warming is; the time constants between them are halved each time
constexpr double kSlowest = 1.0 / 2;  // of the log: the longest time constant of a drift

/// exp(-rate t). t: [N] share of the log, from 0 to 1
ArrayXd Decay(const FittedModel& model, const ArrayXd& t, double rate) {
  const bool even = model.loop && model.loop->intervals().even();
  if (!even) return (-rate * t).exp();

  // for a clock with even steps by products: the part that is computed gives the next part of the same length, so the length
  // doubles each time
  const Index n = t.size();
  const double step = rate / static_cast<double>(n - 1);
  ArrayXd decay = ArrayXd::Ones(n);
  for (Index done = 1; done < n; done *= 2) {
    const Index more = std::min(done, n - done);
    decay.segment(done, more) = std::exp(-step * static_cast<double>(done)) * decay.head(more);
  }
  return decay;
}

/// t: [N] share of the log; slowest: [N] the part of the slowest drift that is still to come. Returns [m x 8]: drifts, level,
/// bend, slope and zeros
WARMJOINT_FOR_EACH_PROCESSOR
MatrixXd Along(const FittedModel& model, const LogSamples& m, const Bins& bins, const ArrayXd& t,
               const ArrayXd& slowest) {
  // the law's forces at a velocity other than that of the sample, in the direction of the sample
  const auto by_speed = [&](Index n, double v, Four& g) {
    const double along = Sign(m.velocity[n]) * v;
    g = Four{1, along * std::abs(v), along * model.energy[n], 0};
  };
  // drifts that die away, each the square of the one before it, so that they end at 1
  const double end = slowest[m.size() - 1], second_end = end * end;
  const Four scale{1, 1 / (1 - end), 1 / (1 - second_end), 1 / (1 - second_end * second_end)};
  const auto levels = [&](Index n, Fours<2>& g) {
    const double first = slowest[n], second = first * first, third = second * second;
    g[0] = scale * Four{t[n], 1 - first, 1 - second, 1 - third};
    by_speed(n, m.velocity[n], g[1]);
  };

  // where the log has the velocity of the losses, that one
  if (!m.loss_velocity) {
    return WithHeat<2>(model, m.velocity, bins, levels, [](Index, Fours<2>&) {});
  }
  return WithHeat<2>(model, m.velocity, bins, levels,
                     [&](Index n, Fours<2>& g) { by_speed(n, (*m.loss_velocity)[n], g[1]); });
}

HeatingForces HeatingForcesOf(const FittedModel& model, const LogSamples& m, const Bins& bins) {
  const double share = 1 / (m.time[m.size() - 1] - m.time[0]);
  const ArrayXd t = (m.time.array() - m.time[0]) * share;
  const MatrixXd all = Along(model, m, bins, t, Decay(model, t, 1 / kSlowest));
  return {all.leftCols(kDrifts), all.col(kDrifts), all.col(kDrifts + 1),
          all.middleCols(kDrifts + 2, model.thermal ? 1 : 0)};
}

constexpr int kMemories = 6;  // time constants that are tried

/// Means over bins of the measured losses filtered with three time constants that span those of a recording. [m x 3]
WARMJOINT_FOR_EACH_PROCESSOR
Eigen::MatrixXd Energies(const FittedModel& model, const LogSamples& m, const Bins& bins,
                         const ThermalFilter& filter) {
  const double duration = m.time[m.size() - 1] - m.time[0];
  const Eigen::VectorXd loss = model.torque.cwiseProduct(m.velocity).cwiseAbs();
  const Fours<1> times{Four{duration / 40, duration / 12, duration / 3, duration}};
  return MeansOfRows<1>(bins, filter.Together(times, loss, 0)).leftCols(3);
}

/// Median duration of the segments; 0 where there are none.
double MedianHold(const FittedModel& model, const LogSamples& m) {
  const std::vector<Segment>& segments = model.selection.segments;
  Eigen::VectorXd durations(static_cast<Eigen::Index>(segments.size()));
  for (size_t i = 0; i < segments.size(); ++i) {
    durations[static_cast<Eigen::Index>(i)] =
        m.time[segments[i].end - 1] - m.time[segments[i].begin];
  }
  return MedianOf(durations);
}

/// Time constants of a memory, s, from half a hold to an eighth of the log. Each is the same multiple of the one before.
std::vector<double> MemoryTimes(double hold, double duration) {
  const double shortest = 0.5 * hold, longest = duration / 8;
  std::vector<double> times;
  if (!(hold > 0) || !(longest > shortest)) return times;
  const double ratio = std::pow(longest / shortest, 1.0 / (kMemories - 1));
  for (int i = 0; i < kMemories; ++i) times.push_back(shortest * std::pow(ratio, i));
  return times;
}

/// Means over bins of |v| after filters of first order, which begin at the first speed, less |v|. [m x times]
WARMJOINT_FOR_EACH_PROCESSOR
Eigen::MatrixXd LateSpeeds(const LogSamples& m, const std::vector<double>& times, const Bins& bins,
                           const ThermalFilter& filter) {
  if (times.empty()) return Eigen::MatrixXd(bins.size(), 0);
  const Eigen::VectorXd speed = m.velocity.cwiseAbs();
  static_assert(kMemories <= 8);
  Fours<2> all;
  for (int i = 0; i < 8; ++i) all[i / 4][i % 4] = times[std::min(i, kMemories - 1)];
  const Eigen::MatrixXd late = MeansOfRows<2>(bins, filter.Together(all, speed, speed[0]));
  return late.leftCols(kMemories).colwise() - bins.Means(speed).col(0);
}

/// The columns of gravity and inertia, each in one recording alone, of all but the first. [N x r (R - 1)]
MatrixXd ByRecording(const MatrixXd& rigid, const LogSamples& m) {
  const std::vector<SampleRange> recordings = m.Recordings();
  const Index r = rigid.cols();
  MatrixXd columns = MatrixXd::Zero(m.size(), r * (std::ssize(recordings) - 1));
  for (Index k = 0; k * r < columns.cols(); ++k) {
    const SampleRange& one = recordings[static_cast<size_t>(k) + 1];
    columns.block(one.first, k * r, one.count, r) = rigid.middleRows(one.first, one.count);
  }
  return columns;
}

// of the largest speed: at slower samples the joint is at rest or turns
constexpr double kMovingShare = 0.05;
constexpr double kAlikeSpeeds = 0.02;

}  // namespace

Circumstances CircumstancesOf(const FittedModel& model, const LogSamples& m, const Bins& bins) {
  const Eigen::MatrixXd none(bins.size(), 0);
  Circumstances circumstances;
  circumstances.torque = bins.Means(model.torque);
  circumstances.residual = bins.Means(model.residual);
  const ThermalFilter filter(m.time, m.further_starts);
  circumstances.energies = Energies(model, m, bins, filter);
  circumstances.initial = circumstances.loads = circumstances.temperatures = none;

  // forces with the heat of their own losses, among them a slope over speed that changes with the heat
  circumstances.heating = HeatingForcesOf(model, m, bins);

  // the start where it is taken to be known, load and temperature where they are logged
  if (model.by_initial_energy.cols() > 0) {
    circumstances.initial = bins.Means(model.by_initial_energy);
  }
  circumstances.weight = bins.Means(model.weight);
  circumstances.by_recording = bins.Means(ByRecording(model.rigid, m));
  if (m.load) circumstances.loads = bins.Means(ConcatColumns(*m.load, m.load->cwiseAbs()));
  if (m.temperature) {
    // about the mean of the log: the bias of a parameter is then that at temperatures of the log, not that at 0 degC
    const Eigen::VectorXd temperature = bins.Means(*m.temperature);
    const double mean = bins.weight.dot(temperature) / bins.weight.sum();
    circumstances.temperatures = (temperature.array() - mean).matrix();
  }

  // friction that follows the speed late, by half a hold to an eighth of the log
  circumstances.duration = m.time[m.size() - 1] - m.time[0];
  circumstances.hold = MedianHold(model, m);
  circumstances.past = MemoryTimes(circumstances.hold, circumstances.duration);
  const Eigen::VectorXd sign = bins.velocity.array().sign();
  circumstances.late_speeds = sign.asDiagonal() * LateSpeeds(m, circumstances.past, bins, filter);
  return circumstances;
}

std::optional<double> OneSpeed(const LogSamples& m) {
  const double largest = m.velocity.cwiseAbs().maxCoeff();
  std::vector<double> speeds;
  for (const double v : m.velocity) {
    if (std::abs(v) > kMovingShare * largest) speeds.push_back(std::abs(v));
  }
  if (speeds.empty()) return std::nullopt;
  std::ranges::sort(speeds);
  const auto at = [&](double share) {
    return speeds[static_cast<std::size_t>(share * static_cast<double>(speeds.size() - 1))];
  };

  // all but the slowest and the fastest tenth must be alike
  const double middle = at(0.5);
  if (at(0.9) - at(0.1) > kAlikeSpeeds * middle) return std::nullopt;
  return middle;
}

}  // namespace warmjoint
