// How sure law, maps and warming are together.
#pragma once

#include "identification/maps/warm_maps.h"

namespace warmjoint {

struct JointUncertainty {
  /// Of law, rigid part, weights, k, log tau, E(0) where it was estimated, jumps, in this order.
  Uncertainty known;
  double end_energy_std = 0;  // of E at the end of the log, N.m or N
};

/// Over the closed loop, in which law and maps make the heat too. residual: [n] N.m or N
JointUncertainty JudgeWarmMaps(const IdentifierInput& input, const WarmMaps& warm,
                               const Eigen::VectorXd& residual);

}  // namespace warmjoint
