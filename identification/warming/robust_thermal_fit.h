// Joint maximum likelihood of law and warming under Huber's loss.
#pragma once

#include "identification/warming/thermal_fit.h"

namespace warmjoint {

/// A fit and how much each sample counted in it.
struct RobustThermalFit {
  ThermalFit fit;
  Eigen::VectorXd weight;  // [N] 0 to 1; of a plain fit: 1 where kept
  double threshold = 0;    // N.m or N, where the loss bends; of a plain fit infinite
};

/// FitThermalFriction again and again, each sample weighted by what Huber's loss makes of its residual
/// in the fit before (robust.h), until the parameters rest; converged says whether they do.
/// Arguments: as of FitThermalFriction; fit: the plain one; spread: [J] standard deviation that each
/// jump of the loop is known to have, N.m or N.
RobustThermalFit RefineByHuber(const ClosedLoop& loop, const Eigen::VectorXd& level,
                               const Eigen::MatrixXd& offsets, const Eigen::VectorXd& kept,
                               ThermalFit fit, const Eigen::VectorXd& spread = {});

}  // namespace warmjoint
