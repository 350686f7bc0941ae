#include "identification/identifiers/nominal_ls.h"

#include <fmt/format.h>

#include "identification/fit_data.h"
#include "identification/fit_parameters.h"
#include "identification/inference/bounds.h"
#include "identification/inference/hold_structure.h"
#include "identification/lagged/lagged_fit.h"
#include "identification/lagged/linear_lag.h"
#include "identification/linear/least_squares.h"
#include "identification/linear/linear_laws.h"
#include "identification/linear/linear_task.h"
#include "identification/linear/robust.h"
#include "identification/uncertainty/disagreement.h"

namespace warmjoint::inline identification {
namespace {

constexpr const char* kName = "nominal-ls";

/// What whitening changes of a fit beyond doubt; nothing where the colour may be noise. A: [n x d];
/// torque: [n].
std::optional<Disagreement> FindStructure(const Eigen::MatrixXd& A, const Eigen::VectorXd& torque,
                                          const LeastSquares& plain, const LeastSquares& white,
                                          const Whitening& whitening, const Selection& selection) {
  const Uncertainty known =
      JudgeUncertainty(A, plain.cofactor, torque - A * plain.solution, selection);
  return FindDisagreement({plain.solution, known.covariance},
                          {white.solution, whitening.noise().innovation * white.cofactor},
                          known.freedom);
}

Fit FitLaw(const IdentifierInput& given) {
  if (auto why = WhyNoLag(given)) return Refused(kName, Status::bad_data, *why);
  LinearTask task = BeginLinear(given, 0);
  if (task.refusal) return Refused(kName, *task.refusal);
  const auto& [law, gravity, columns, refusal] = task;
  const IdentifierInput input = gravity.Of(given);
  const Measurements& m = input.measurements;

  // rows of (9) on the samples that satisfy (6)
  const Eigen::MatrixXd A = Kept(columns, input.selection);
  const Eigen::VectorXd torque = Kept(m.torque, input.selection);
  const bool huber = input.options.Text("loss") == "huber";
  RobustLeastSquares robust =
      huber ? SolveHuber(A, torque)
            : RobustLeastSquares{SolveLeastSquares(A, torque), kInfinity, true};
  LeastSquares& solved = robust.fit;
  if (solved.rank < task.count()) {
    return Refused(kName, Status::not_identifiable,
                   IndistinctColumns(solved.mixed, law, gravity, input));
  }
  if (!robust.converged) {
    return Refused(kName, Status::not_converged,
                   "the weights of Huber's loss still move after 100 rounds; use loss squares");
  }

  // once more behind the lag of the torque, or where the noise is coloured beyond doubt
  std::shared_ptr<const LaggedRows> lag;
  if (AsksForLag(given)) {
    const auto runs = std::make_shared<const KeptRuns>(FindRuns(m, input.selection));
    if (auto behind = FitLinearLag(runs, A, torque, A * solved.solution)) {
      lag = behind->rows;
      solved = std::move(behind->fit);
    }
  }
  std::shared_ptr<const Whitening> whitening;
  std::optional<Disagreement> structure;
  if (!huber && !lag) whitening = WhiteningFor(torque - A * solved.solution, m, input.selection);
  if (whitening) {
    LeastSquares white = SolveLeastSquares(whitening->Of(A), whitening->Of(torque));
    if (white.rank == task.count())
      structure = FindStructure(A, torque, solved, white, *whitening, input.selection);
    const bool is_friction =
        white.rank == task.count() &&
        !LeavesBounds(LawParameters(law, white.solution.head(task.law_count()), m));
    if (structure || !is_friction) whitening = nullptr;
    if (whitening) solved = std::move(white);
  }

  // the law, gravity beside it
  const Eigen::VectorXd values = solved.solution.head(task.law_count());
  Fit fit;
  fit.identifier = kName;
  fit.friction = FrictionOf(law, values, m);
  fit.parameters = LawParameters(law, values, m);
  AddRigid(gravity, solved.solution.tail(gravity.count()), m, fit);

  // and how well they fit
  fit.used = input.selection;
  fit.torque = torque;
  fit.fitted = A * solved.solution;
  fit.errors.cofactor = solved.cofactor;
  fit.errors.whitening = whitening;
  if (huber) fit.errors.scores = HuberScores(fit.residual(), robust.threshold);
  if (huber) fit.loss_bend = robust.threshold;
  fit.count = task.count();
  fit.effective_parameters = task.count();
  fit.summary = fmt::format("law {} by least squares on {} samples{}{}{}", law.name, torque.size(),
                            m.acceleration ? kOfAnyMotion : "", lag ? kBehindLag : "",
                            whitening ? kWhitened : "");
  const Eigen::VectorXd friction = A.leftCols(task.law_count()) * values;
  fit.jacobian = [all = std::move(task.columns)] { return all; };
  if (structure) HoldStructure(*structure, friction, fit);
  if (lag) AddLag(lag, fit.jacobian() * solved.solution, m, fit);
  if (!lag && AsksForLag(given)) fit.afterword = kNoLagSeen;
  return fit;
}

}  // namespace

Identifier NominalLs() {
  return {kName,
          "a nominal law by linear least squares, without warming",
          {{"law", "viscous_coulomb", LinearLawWords(), "nominal friction law"},
           GravityOption(),
           MotionOption(),
           LossOption(),
           TorqueLagOption()},
          &FitLaw};
}

}  // namespace warmjoint::inline identification
