// Dependence of a residual on what changes from segment to segment: time, energy, speed, direction.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/adequacy/cells.h"
#include "identification/adequacy/structure.h"

namespace warmjoint {

/// What smooth structure left, and what it was.
struct SmoothFindings {
  std::vector<Structure> found;  // in the order in which each explained most of what was left
  Eigen::VectorXd explained;     // [m] what they and the parameters take up in each cell, N.m or N
};

/// Tests blocks of features against the residual, beside the fit's own derivatives: what a block
/// explains is what the fit cannot take up itself. Blocks, s = sign(v), u = |v|/max|v|:
///   direction  1, |v|                    speed   s u^2, s exp(-u/0.1), s exp(-u/0.3)
///   energy     s E of three time constants     time    s cos(k pi t), k = 1..4; cos(k pi t), k =
///   1, 2
/// Each block's coefficients are tested by Hotelling's T^2 with the covariance of their scores over
/// kParts parts of the recording, which holds for noise of any colour that forgets within a part.
/// Found is the block that explains most; it joins the fit, and the others are tested again.
/// residual: [m] mean tau - F of each cell; derivatives: [m x p] mean dF/dx; energies: [m x 3] mean
/// of the measured losses, filtered; initial: [m x 1] mean dF/dE(0), or [m x 0] where there is no
/// E(0) to look for.
SmoothFindings FindSmoothStructure(const Cells& cells, const Eigen::VectorXd& residual,
                                   const Eigen::MatrixXd& derivatives,
                                   const Eigen::MatrixXd& energies, const Eigen::MatrixXd& initial);

}  // namespace warmjoint
