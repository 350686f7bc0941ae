#include "identification/warming/further_passes.h"

#include <cmath>
#include <utility>

#include "identification/warming/expected_start.h"

namespace warmjoint {
namespace {

/// Once more from where a fit ended, with what is known of E(0) and the noise that the fit left.
ThermalFit Again(ThermalRows rows, const InitialEnergy& initial, const ThermalFit& fit) {
  rows.initial = initial;
  rows.scale = std::sqrt(fit.squares / rows.weight.sum());
  ThermalFit next = FitThermalFriction(rows, StartFrom(fit));
  next.Follow(fit);
  return next;
}

}  // namespace

Eigen::VectorXd FitJumps(ThermalRows rows, const std::vector<LogGap>& gaps, ThermalFit& fit) {
  // how large jumps may be, by the energy without them
  const Thermal thermal = fit.thermal();
  const LoopResponse response =
      rows.loop.Simulate(fit.law(), thermal, fit.initial_energy(), fit.jumps());
  const ClosedLoop loop = rows.loop.WithJumps(Behind(gaps));
  rows.jump_spread = JumpSpread(gaps, response.energy.cwiseAbs().maxCoeff(), thermal.time_constant);
  fit = Again(rows.Along(loop), fit.initial, fit);
  return rows.jump_spread;
}

std::string RefitStart(const ThermalRows& rows,
                       const std::function<double(const ThermalFit&)>& deviation, ThermalFit& fit) {
  const InitialEnergy initial = fit.initial;
  if (!initial.is_expected()) return "";

  // the log alone, which says what its noise is, too
  const ThermalFit alone = Again(rows, InitialEnergy::estimated, fit);
  if (alone.converged) {
    const std::string unlike =
        ContradictsExpected(initial, alone.initial_energy(), deviation(alone));
    if (!unlike.empty()) {
      fit = alone;
      return unlike;
    }
  }
  // no contradiction: both together, from where the better fit ended
  const ThermalFit& better = alone.converged ? alone : fit;
  fit = Again(rows, initial, better);
  return "";
}

}  // namespace warmjoint
