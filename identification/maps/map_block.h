// Law and maps beside one course of the heat after the other.
#pragma once

#include <memory>
#include <optional>

#include "identification/maps/identify_maps.h"

namespace warmjoint {

/// The block of law and maps where they and a warming are fitted in turn: what does not depend on E is made
/// once.
class MapBlock {
 public:
  /// input: must outlive this; task: its energy is not read.
  MapBlock(const IdentifierInput& input, MapTask task);

  /// Chooses shape and strength beside E, and fits. energy: [N] N.m or N, or empty: 0. False where nothing
  /// can be solved.
  bool ChooseBeside(const Eigen::VectorXd& energy);
  /// Fits once more with the shape and strength that were chosen last.
  bool FitBeside(const Eigen::VectorXd& energy);

  const MapWeights& fit() const { return *fit_; }
  /// Of the residual over the kept samples.
  double Squares() const { return (torque_ - fit_->fitted).squaredNorm(); }
  /// Values of the maps at all samples, [N] N.m or N.
  Eigen::VectorXd Everywhere() const;

  /// The latest fit, and how sure it is.
  MapFit Complete() const { return repeated_->Complete(*fit_); }
  /// The task with the choice made, and the latest E.
  MapTask Settled() const;

 private:
  const IdentifierInput& input_;
  MapTask task_;
  MapPoints everywhere_;                        // [N x 5]
  std::shared_ptr<const KernelRows> all_rows_;  // of the shape that was chosen, at all samples
  std::optional<ChosenProblem> chosen_;
  std::unique_ptr<RepeatedFit> repeated_;  // of what was chosen
  Eigen::VectorXd torque_;                 // [n] what the latest E leaves
  std::optional<MapWeights> fit_;
};

}  // namespace warmjoint
