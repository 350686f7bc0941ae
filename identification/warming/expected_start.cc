#include "identification/warming/expected_start.h"

#include <fmt/format.h>

#include <cmath>

namespace warmjoint {
namespace {

constexpr double kBeyondDoubt = 4;  // deviations

/// Once more from where a fit ended, which it takes the place of.
ThermalFit Again(const ClosedLoop& loop, const Eigen::VectorXd& level,
                 const Eigen::MatrixXd& offsets, const Eigen::VectorXd& kept,
                 const InitialEnergy& initial, const ThermalFit& fit) {
  const double scale = std::sqrt(fit.solution.squares / kept.sum());
  ThermalFit next = FitThermalFriction(loop, level, offsets, kept, StartFrom(fit), initial, scale,
                                       fit.jump_weights);
  next.trace.insert(next.trace.begin(), fit.trace.begin(), fit.trace.end());
  return next;
}

}  // namespace

bool TakesColdStart(const Options& options) {
  const auto* start = options.Find<InitialEnergyOptions>();
  return start && start->initial_energy == StartOfHeat::zero;
}

InitialEnergy InitialEnergyOf(const Options& options) {
  const auto& start = options.Get<InitialEnergyOptions>();
  if (start.initial_energy == StartOfHeat::zero) return InitialEnergy::zero;
  if (start.initial_energy == StartOfHeat::estimated) return InitialEnergy::estimated;
  return {start.expected_energy, std::max(start.expected_energy_std, InitialEnergy::kExact)};
}

std::string UnlikeBefore(const InitialEnergy& expected, double found, double deviation) {
  const double off = found - expected.mean;
  if (std::abs(off) <= kBeyondDoubt * std::hypot(deviation, expected.spread)) return "";
  return fmt::format(
      "the log begins at a heat of {:.3g}, not at the {:.3g} +- {:.2g} that the recording before "
      "it left: E(0) is taken from this log alone; check the pause, and that the joint rested in "
      "it",
      found, expected.mean, expected.spread);
}

std::string WeighStart(const ClosedLoop& loop, const Eigen::VectorXd& level,
                       const Eigen::MatrixXd& offsets, const Eigen::VectorXd& kept,
                       const std::function<double(const ThermalFit&)>& deviation, ThermalFit& fit) {
  const InitialEnergy initial = fit.initial;
  if (!initial.is_expected()) return "";

  // the log alone, which says what its noise is, too
  const ThermalFit alone = Again(loop, level, offsets, kept, InitialEnergy::estimated, fit);
  if (alone.converged) {
    const std::string unlike = UnlikeBefore(initial, alone.initial_energy(), deviation(alone));
    if (!unlike.empty()) {
      fit = alone;
      return unlike;
    }
  }
  // no contradiction: both together, from where the better fit ended
  const ThermalFit& better = alone.converged ? alone : fit;
  fit = Again(loop, level, offsets, kept, initial, better);
  return "";
}

}  // namespace warmjoint
