#include "identification/identifiers/nominal_ls.h"

#include <fmt/format.h>

#include "identification/describe_friction.h"
#include "identification/fit_data.h"
#include "identification/linear/least_squares.h"
#include "identification/linear/linear_laws.h"
#include "identification/linear/linear_task.h"
#include "identification/linear/report_law.h"
#include "identification/linear/robust.h"

namespace warmjoint::inline identification {
namespace {

constexpr const char* kName = "nominal-ls";

Estimate Identify(const IdentifierInput& given) {
  const LinearTask task = BeginLinear(given, kName, 0);
  if (task.refusal) return *task.refusal;
  const auto& [law, gravity, columns, refusal] = task;
  const IdentifierInput input = gravity.Of(given);
  const int d = task.count();

  // rows of (9) on the samples that satisfy (6)
  const Eigen::MatrixXd A = Kept(columns, input.selection);
  const Eigen::VectorXd torque = Kept(input.measurements.torque, input.selection);
  const bool huber = input.options.Text("loss") == "huber";
  const RobustLeastSquares robust =
      huber ? SolveHuber(A, torque)
            : RobustLeastSquares{SolveLeastSquares(A, torque), kInfinity, true};
  const LeastSquares& fit = robust.fit;
  if (fit.rank < d) {
    return Failed(kName, Status::not_identifiable,
                  IndistinctColumns(fit.mixed, law, gravity, input));
  }
  if (!robust.converged) {
    return Failed(kName, Status::not_converged,
                  "the weights of Huber's loss still move after 100 rounds; use loss squares");
  }

  Estimate estimate;
  estimate.identifier = kName;
  const Eigen::VectorXd fitted = A * fit.solution;
  const Eigen::VectorXd score = HuberScores(torque - fitted, robust.threshold);
  const Uncertainty known = JudgeUncertainty(A, fit.cofactor, score, input.selection, fitted);
  ReportLaw(law, fit.solution.head(task.law_count()), known, input.measurements, estimate);
  ReportGravity(gravity, fit.solution, known, input.measurements, estimate);
  estimate.metrics = ComputeMetrics(torque, fitted, d, d);
  estimate.message =
      fmt::format("law {} by least squares on {} samples{}{}", law.name, torque.size(),
                  DescribeLoss(torque - fitted, robust.threshold), NoiseOf(known));
  DescribeFriction(law, input.measurements, estimate);
  return estimate;
}

}  // namespace

Identifier NominalLs() {
  return {kName,
          "a nominal law by linear least squares, without warming",
          {{"law", "viscous_coulomb", LinearLawWords(), "nominal friction law"},
           GravityOption(),
           LossOption()},
          &Identify};
}

}  // namespace warmjoint::inline identification
