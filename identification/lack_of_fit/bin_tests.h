// The tests over bins: what changes from segment to segment.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/lack_of_fit/error_level.h"
#include "identification/lack_of_fit/table.h"

namespace warmjoint {

/// What tests over bins found.
struct BinFindings {
  std::vector<Finding> findings;  // one for each test that was asked, in the order of the table
  Eigen::VectorXd explained;      // [m] what those rejected and the parameters take up, N.m or N
};

/// Makes tests one after the other: of those that reject, the features of the largest gain join the
/// fit, and the others are made again beside it, until none rejects. Too few rows for all features
/// leave the last tests out: two rows in three are left to tell the noise.
/// tests: rows of the table with features; residual: [m] mean tau - F of each bin; derivatives:
/// [m x p] mean dF/dx.
BinFindings TestBins(const std::vector<const LackOfFitTest*>& tests, const Bins& bins,
                     const Eigen::VectorXd& residual, const Eigen::MatrixXd& derivatives,
                     const Circumstances& known, ErrorLevel& level);

}  // namespace warmjoint
