// Dependence of a residual on what changes from segment to segment: time, energy, speed, direction.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/adequacy/cells.h"
#include "identification/adequacy/structure.h"

namespace warmjoint::inline identification {

/// What smooth structure left, and what it was.
struct SmoothFindings {
  std::vector<Structure> found;  // in the order in which they joined the fit
  Eigen::VectorXd explained;     // [m] what they and the parameters take up in each cell, N.m or N
};

/// What the joint went through, as means over each cell; [m x 0] where it is not known or not
/// asked.
struct Circumstances {
  Eigen::MatrixXd energies;      // [m x 3] the measured losses, filtered; N.m or N per unit of gain
  Eigen::MatrixXd slopes;        // [m x 1] v E, E that of the fit, where it knows warming
  Eigen::MatrixXd initial;       // [m x 1] dF/dE(0), where it is taken to be known
  Eigen::MatrixXd loads;         // [m x 2] L, |L|; N.m or N
  Eigen::MatrixXd temperatures;  // [m x 1] degC
};

/// Tests blocks of features against the residual, beside the fit's own derivatives (growing_fit.h):
/// what a block explains is what the fit cannot take up itself. Blocks, s = sign(v),
/// u = |v|/max|v|:
///   direction  1, |v|                           speed           s u^2, s exp(-u/0.1), s
///   exp(-u/0.3) energy     s E of three time constants      speed x energy  v E of the fit initial
///   energy  dF/dE(0)                    time            s cos(k pi t), k = 1..4;
///                                                               cos(k pi t), k = 1, 2
/// Found is the block of the largest merit; it joins the fit, and the others are tested again.
/// residual: [m] mean tau - F of each cell; derivatives: [m x p] mean dF/dx.
SmoothFindings FindSmoothStructure(const Cells& cells, const Eigen::VectorXd& residual,
                                   const Eigen::MatrixXd& derivatives,
                                   const Circumstances& circumstances);

}  // namespace warmjoint::inline identification
