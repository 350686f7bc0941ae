#include "identification/nominal_ls.h"

#include <fmt/format.h>

#include "identification/describe_friction.h"
#include "identification/fit_data.h"
#include "identification/fit_gravity.h"
#include "identification/least_squares.h"
#include "identification/linear_laws.h"
#include "identification/report_law.h"
#include "identification/robust.h"

namespace warmjoint {
namespace {

constexpr const char* kName = "nominal-ls";

Estimate Identify(const IdentifierInput& given) {
  const Law& law = *FindLaw(given.options.Text("law"));
  const GravityFit gravity = PrepareGravity(given);
  if (gravity.why) return Failed(kName, gravity.status, *gravity.why);
  const IdentifierInput input = gravity.Of(given);
  const auto d = static_cast<int>(law.parameters.size() + gravity.count());
  if (auto why = Unusable(input, d)) return Failed(kName, Status::bad_data, *why);

  // rows of (9) on the samples that satisfy (6)
  const Eigen::MatrixXd A =
      Kept(Beside(LawColumns(law, input.measurements.velocity), gravity.columns), input.selection);
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
  const Uncertainty known = JudgeUncertainty(A, fit.cofactor, score, input.selection);
  ReportLaw(law, fit.solution.head(d - gravity.count()), known, input.measurements, estimate);
  ReportGravity(gravity, fit.solution, known, input.measurements, estimate);
  estimate.metrics = ComputeMetrics(torque, fitted, d, d);
  estimate.message =
      fmt::format("law {} by least squares on {} samples{}{}", law.name, torque.size(),
                  DescribeLoss(torque - fitted, robust.threshold), ColourOf(known.noise));
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

}  // namespace warmjoint
