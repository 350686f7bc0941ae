// The warming beside one fit of law and maps after the other.
#pragma once

#include <optional>
#include <vector>

#include "identification/maps/map_block.h"
#include "identification/warming/gaps.h"
#include "identification/warming/thermal_fit.h"

namespace warmjoint {

/// The other block of those fitted in turn (map_block.h): the warming, the law and one factor on the maps
/// over the closed loop.
class WarmingBlock {
 public:
  /// input, task: must outlive this; of the task, law, gravity and inertia are read; initial: what is
  /// known of E(0).
  WarmingBlock(const IdentifierInput& input, const MapTask& task, const InitialEnergy& initial);

  /// Fits beside the maps' latest, from the warming that was found last, or from a scan. False where
  /// it does not converge.
  bool FitBeside(const MapBlock& maps);

  const ThermalFit& fit() const { return *fit_; }
  const Eigen::VectorXd& energy() const { return energy_; }  // [N] E, N.m or N
  const std::vector<LogGap>& gaps() const { return gaps_; }  // where E jumps

 private:
  const IdentifierInput& input_;
  const MapTask& task_;
  const InitialEnergy initial_;
  const std::vector<LogGap> gaps_;
  const Eigen::VectorXd kept_;  // [N] 1 where a sample counts
  std::optional<ThermalFit> fit_;
  Eigen::VectorXd energy_;
};

}  // namespace warmjoint
