// A model that is linear in its parameters, behind a lag of the torque.
#pragma once

#include <memory>
#include <optional>

#include "identification/lagged/lagged_rows.h"
#include "identification/linear/least_squares.h"

namespace warmjoint {

struct LinearLag {
  std::shared_ptr<const LaggedRows> rows;
  LeastSquares fit;  // of the mapped rows
};

/// The lag that leaves the least squares (SearchLag), and the fit behind it. A: [n x d] rows of the model
/// without lag; measured, without: [n] as of SearchLag. Nothing where no lag is seen.
std::optional<LinearLag> FitLinearLag(const std::shared_ptr<const KeptRuns>& runs,
                                      const Eigen::MatrixXd& A, const Eigen::VectorXd& measured,
                                      const Eigen::VectorXd& without);

}  // namespace warmjoint
