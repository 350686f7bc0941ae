#include "identification/identifiers/nominal_ls.h"

#include <fmt/format.h>

#include "identification/fit_data.h"
#include "identification/fit_parameters.h"
#include "identification/linear/least_squares.h"
#include "identification/linear/linear_laws.h"
#include "identification/linear/linear_task.h"
#include "identification/linear/robust.h"

namespace warmjoint::inline identification {
namespace {

constexpr const char* kName = "nominal-ls";

Fit FitLaw(const IdentifierInput& given) {
  LinearTask task = BeginLinear(given, 0);
  if (task.refusal) return Refused(kName, *task.refusal);
  const auto& [law, gravity, columns, refusal] = task;
  const IdentifierInput input = gravity.Of(given);
  const Measurements& m = input.measurements;

  // rows of (9) on the samples that satisfy (6)
  const Eigen::MatrixXd A = Kept(columns, input.selection);
  const Eigen::VectorXd torque = Kept(m.torque, input.selection);
  const bool huber = input.options.Text("loss") == "huber";
  const RobustLeastSquares robust =
      huber ? SolveHuber(A, torque)
            : RobustLeastSquares{SolveLeastSquares(A, torque), kInfinity, true};
  const LeastSquares& solved = robust.fit;
  if (solved.rank < task.count()) {
    return Refused(kName, Status::not_identifiable,
                   IndistinctColumns(solved.mixed, law, gravity, input));
  }
  if (!robust.converged) {
    return Refused(kName, Status::not_converged,
                   "the weights of Huber's loss still move after 100 rounds; use loss squares");
  }

  // the law, gravity beside it
  const Eigen::VectorXd values = solved.solution.head(task.law_count());
  Fit fit;
  fit.identifier = kName;
  fit.friction = FrictionOf(law, values, m);
  fit.parameters = LawParameters(law, values, m);
  AddGravity(gravity, solved.solution.tail(gravity.count()), m, fit);

  // and how well they fit
  fit.used = input.selection;
  fit.torque = torque;
  fit.fitted = A * solved.solution;
  fit.errors.cofactor = solved.cofactor;
  if (huber) fit.errors.scores = HuberScores(fit.residual(), robust.threshold);
  if (huber) fit.loss_bend = robust.threshold;
  fit.count = task.count();
  fit.effective_parameters = task.count();
  fit.summary = fmt::format("law {} by least squares on {} samples", law.name, torque.size());
  fit.jacobian = [all = std::move(task.columns)] { return all; };
  return fit;
}

}  // namespace

Identifier NominalLs() {
  return {kName,
          "a nominal law by linear least squares, without warming",
          {{"law", "viscous_coulomb", LinearLawWords(), "nominal friction law"},
           GravityOption(),
           LossOption()},
          &FitLaw};
}

}  // namespace warmjoint::inline identification
