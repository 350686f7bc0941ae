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

/// FitJumps with the E(0) that the fit has or knows. before: the loop of that fit; rows: with the jumps
Eigen::VectorXd AddJumps(const ClosedLoop& before, ThermalRows rows,
                         const std::vector<LogGap>& gaps, ThermalFit& fit) {
  const Thermal thermal = fit.thermal();
  // how large jumps may be, by the energy without them
  const LoopResponse response =
      before.Simulate(fit.law(), thermal, fit.initial_energy(), fit.jumps());
  rows.jump_spread = JumpSpread(gaps, response.energy.cwiseAbs().maxCoeff(), thermal.time_constant);
  fit = Again(rows, fit.initial, fit);
  return rows.jump_spread;
}

}  // namespace

Eigen::VectorXd FitJumps(const ThermalRows& rows, const std::vector<LogGap>& gaps,
                         const InitialGuess& scanned, ThermalFit& fit) {
  const ClosedLoop loop = rows.loop.WithJumps(Behind(gaps));
  const ThermalRows with = rows.Along(loop);
  Eigen::VectorXd spread = AddJumps(rows.loop, with, gaps, fit);
  if (!fit.estimates_initial_energy()) return spread;

  // the other order: a cold start, jumps, then E(0)
  ThermalRows cold = rows;
  cold.initial = InitialEnergy::zero;
  cold.scale = std::sqrt(fit.squares / rows.weight.sum());
  ThermalFit other = FitThermalFriction(cold, scanned);
  if (!other.converged) return spread;
  ThermalRows freed_rows = with;
  freed_rows.jump_spread = AddJumps(rows.loop, with, gaps, other);
  ThermalFit freed = Again(freed_rows, fit.initial, other);
  // taken where it converges and leaves smaller squares
  const bool leaves_less = !(fit.converged && fit.squares <= freed.squares);
  if (!freed.converged || !leaves_less) return spread;
  fit = std::move(freed);
  return freed_rows.jump_spread;
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
