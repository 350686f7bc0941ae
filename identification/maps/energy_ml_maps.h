// Joint maximum likelihood of law and warming with maps over the joint's or the motor's angle.
#pragma once

#include <warmjoint/friction.h>

#include <Eigen/Core>
#include <optional>

#include "identification/identifier.h"

namespace warmjoint::inline identification {

/// position=none|map|motor, and what says how the maps are made.
std::vector<OptionInfo> WarmMapOptions();

/// Law, warming and the maps that the option `position` names, together. Refuses options that
/// cannot be had with maps: gravity, an estimated E(0), Huber's loss.
Fit FitWithMaps(const std::string& identifier, const IdentifierInput& input);

/// A shape of maps, and a prior.
struct ChosenMap {
  FrictionMap map;      // the first of them
  double strength = 0;  // of the prior
};

/// The maps that the option `position` names, with the kernels that suit the log beside a warming that is known;
/// nothing where none can be chosen. energy: [N] E, N.m or N, or empty: 0.
std::optional<ChosenMap> MapBesideEnergy(const IdentifierInput& input,
                                         const Eigen::VectorXd& energy);

}  // namespace warmjoint::inline identification
