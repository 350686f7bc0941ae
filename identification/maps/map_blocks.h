// The start of the fit of law, maps and heat: law and maps given the heat, and the heat given the maps.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "identification/maps/identify_maps.h"
#include "identification/warming/gaps.h"
#include "identification/warming/thermal_fit.h"

namespace warmjoint {

/// Law and maps with one energy after the other: what does not depend on E is computed once.
class MapBlock {
 public:
  /// input: must outlive this; task: its energy is not read.
  MapBlock(const IdentifierInput& input, MapTask task);

  /// Chooses shape and strength given E, and fits. energy: [N] N.m or N, or empty: 0. False where nothing
  /// can be solved.
  bool ChooseGiven(const Eigen::VectorXd& energy);
  /// Fits once more with the shape and strength that were chosen last.
  bool FitGiven(const Eigen::VectorXd& energy);

  /// Takes an x that was found otherwise, with its energy. x: [p + q]
  void Take(Eigen::VectorXd x, const Eigen::VectorXd& energy);

  const MapWeights& fit() const { return *fit_; }
  const RepeatedFit& solver() const { return *repeated_; }
  /// The squares of the residual over the kept samples.
  double Squares() const { return (torque_ - fit_->fitted).squaredNorm(); }
  /// Values of the maps at all samples, [N] N.m or N.
  Eigen::VectorXd Everywhere() const;

  /// The latest fit, and how sure it is.
  MapFit Complete() const { return repeated_->Complete(*fit_); }
  /// The task with the choice made, and the latest E.
  MapTask Settled() const;

 private:
  /// Sets the torque of law and maps to the measured one less that of an energy.
  void LeaveTo(const Eigen::VectorXd& energy);

  const IdentifierInput& input_;
  MapTask task_;
  MapPoints everywhere_;                        // [N x 5]
  std::shared_ptr<const KernelRows> all_rows_;  // of the shape that was chosen, at all samples
  std::optional<ChosenProblem> chosen_;
  std::unique_ptr<RepeatedFit> repeated_;  // of what was chosen
  Eigen::VectorXd torque_;                 // [n] what the latest E leaves
  std::optional<MapWeights> fit_;
};

/// The warming, the law and one factor on the maps over the closed loop, with one fit of the maps after the other.
class WarmingBlock {
 public:
  /// input, task: must outlive this; of the task, law, gravity and inertia are read; initial: what is
  /// known of E(0).
  WarmingBlock(const IdentifierInput& input, const MapTask& task, const InitialEnergy& initial);

  /// Fits given the latest maps, from the warming that was found last, or from a scan. False where
  /// it does not converge.
  bool FitGiven(const MapBlock& maps);

  const ThermalFit& fit() const { return *fit_; }
  const Eigen::VectorXd& energy() const { return energy_; }  // [N] E, N.m or N
  const std::vector<LogGap>& gaps() const { return gaps_; }  // where E jumps: gaps, further starts

 private:
  const IdentifierInput& input_;
  const MapTask& task_;
  const InitialEnergy initial_;
  const std::vector<LogGap> starts_;  // of further recordings, where E(0) is estimated
  const std::vector<LogGap> gaps_;
  const Eigen::Array<bool, Eigen::Dynamic, 1> kept_;  // [N] whether a sample counts
  std::optional<ThermalFit> fit_;
  Eigen::VectorXd energy_;
};

}  // namespace warmjoint
