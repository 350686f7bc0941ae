#include "identification/lagged/linear_lag.h"

#include "identification/lagged/lagged_fit.h"

namespace warmjoint {

std::optional<LinearLag> FitLinearLag(const std::shared_ptr<const KeptRuns>& runs,
                                      const Eigen::MatrixXd& A, const Eigen::VectorXd& measured,
                                      const Eigen::VectorXd& without) {
  // the fit at one lag: columns and torque on rows that hold nothing of any d
  const auto solve = [&](const LaggedRows& rows) {
    return SolveLeastSquares(rows.Of(A), rows.Of(rows.Unlagged(measured)));
  };
  // the lag that leaves the least squares
  auto rows = SearchLag(runs, measured, without, [&](const LaggedRows& at) -> ModelBehindLag {
    const LeastSquares one = solve(at);
    // columns that are not told apart make no fit
    if (one.rank < A.cols()) return {};
    Eigen::VectorXd torque = A * one.solution;
    const Eigen::VectorXd left = at.Of(at.Unlagged(measured) - torque);
    return {left.squaredNorm(), std::move(torque)};
  });

  // the fit behind it
  if (!rows) return std::nullopt;
  LeastSquares fit = solve(*rows);
  return LinearLag{std::move(rows), std::move(fit)};
}

}  // namespace warmjoint
