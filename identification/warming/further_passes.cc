#include "identification/warming/further_passes.h"

#include <cmath>
#include <utility>

#include "identification/fit_data.h"

namespace warmjoint {

namespace {

/// FitJumps beside the E(0) that the fit has or knows. loop: with the jumps
Eigen::VectorXd AddJumps(const ClosedLoop& loop, const Eigen::VectorXd& level,
                         const Eigen::MatrixXd& offsets, const Eigen::VectorXd& kept,
                         const std::vector<LogGap>& gaps, ThermalFit& fit) {
  const Thermal thermal = fit.thermal();
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(gaps.size()));
  // how large jumps may be, by the energy without them
  const LoopResponse response =
      loop.Simulate(fit.parameters(), thermal, fit.initial_energy(), none);
  const Eigen::VectorXd spread =
      JumpSpread(gaps, response.energy.cwiseAbs().maxCoeff(), thermal.time_constant);
  // how much noise there is, by the squares so far
  const double scale = std::sqrt(fit.solution.squares / kept.sum());
  ThermalFit next = FitThermalFriction(loop, level, offsets, kept, StartFrom(fit), fit.initial,
                                       scale, JumpWeights(scale, spread));
  next.trace.insert(next.trace.begin(), fit.trace.begin(), fit.trace.end());
  fit = std::move(next);
  return spread;
}

}  // namespace

Eigen::VectorXd FitJumps(ClosedLoop& loop, const Eigen::VectorXd& level,
                         const Eigen::MatrixXd& offsets, const Eigen::VectorXd& kept,
                         const std::vector<LogGap>& gaps, const InitialGuess& scanned,
                         ThermalFit& fit) {
  const ClosedLoop without = std::exchange(loop, loop.WithJumps(Behind(gaps)));
  const Eigen::VectorXd spread = AddJumps(loop, level, offsets, kept, gaps, fit);
  if (!fit.estimates_initial_energy()) return spread;

  // the other way: a cold start, jumps, then E(0)
  const double scale = std::sqrt(fit.solution.squares / kept.sum());
  ThermalFit other =
      FitThermalFriction(without, level, offsets, kept, scanned, InitialEnergy::zero, scale);
  if (!other.converged) return spread;
  // the start E(0) beside those jumps
  const Eigen::VectorXd other_spread = AddJumps(loop, level, offsets, kept, gaps, other);
  ThermalFit freed =
      FitThermalFriction(loop, level, offsets, kept, StartFrom(other), fit.initial,
                         std::sqrt(other.solution.squares / kept.sum()), other.jump_weights);
  // taken where it converges and leaves smaller squares
  const bool leaves_less = !(fit.converged && fit.solution.squares <= freed.solution.squares);
  if (!freed.converged || !leaves_less) return spread;
  freed.trace.insert(freed.trace.begin(), other.trace.begin(), other.trace.end());
  fit = std::move(freed);
  return other_spread;
}

std::shared_ptr<const Whitening> FitWhitened(const Measurements& m, const Selection& moving,
                                             const ClosedLoop& loop, const Eigen::VectorXd& level,
                                             const Eigen::MatrixXd& offsets,
                                             const Eigen::VectorXd& spread,
                                             const LoopResponse& response, ThermalFit& fit) {
  if (!fit.converged || response.feeds_itself) return nullptr;
  // what the fit leaves, and the noise in it
  const Eigen::VectorXd left =
      loop.direction().cwiseProduct(level - offsets * fit.offset_values()) - response.force;
  auto whitening = WhiteningFor(Kept(left, moving), m, moving);
  if (!whitening) return nullptr;

  // the same fit by whitened rows
  const double scale = std::sqrt(whitening->noise().innovation);
  ThermalFit next =
      FitThermalFriction(loop, level, offsets, moving.keep.cast<double>(), StartFrom(fit),
                         fit.initial, scale, JumpWeights(scale, spread), whitening.get());
  if (!next.converged) return nullptr;
  next.trace.insert(next.trace.begin(), fit.trace.begin(), fit.trace.end());
  fit = std::move(next);
  return whitening;
}

}  // namespace warmjoint
