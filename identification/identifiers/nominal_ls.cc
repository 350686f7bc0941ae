// Identifier `nominal-ls`: a nominal law by linear least squares, Eqs. (7)-(9).
//
// x = argmin |A x - tau|, rows of A as in Eq. (9): [v, sign v] for law (2). Standard deviations
// as in uncertainty.h, right for coloured noise too.
// not_identifiable where the motion makes columns of A alike, bad_data where nothing can be
// fitted.
#include <fmt/format.h>

#include <cmath>
#include <tuple>
#include <utility>

#include "identification/fit_data.h"
#include "identification/fit_parameters.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/lagged/lagged_fit.h"
#include "identification/lagged/linear_lag.h"
#include "identification/linear/least_squares.h"
#include "identification/linear/linear_laws.h"
#include "identification/linear/rigid_part.h"
#include "identification/linear/robust.h"
#include "identification/physical_bounds.h"
#include "identification/seen_samples.h"
#include "identification/uncertainty/disagreement.h"

namespace warmjoint {
namespace {

constexpr const char* kName = "nominal-ls";

/// What whitening changes of a fit beyond doubt; nothing where the colour may be noise. A: [n x d];
/// torque: [n].
std::optional<Disagreement> FindStructure(const Eigen::MatrixXd& A, const Eigen::VectorXd& torque,
                                          const LeastSquares& plain, const LeastSquares& white,
                                          const Whitening& whitening, const Selection& selection) {
  const Uncertainty known =
      EstimateCovariance(A, plain.cofactor, torque - A * plain.solution, selection);
  return FindDisagreement({plain.solution, known.covariance},
                          {white.solution, whitening.noise().innovation * white.cofactor},
                          known.freedom);
}

/// The rows of (9) on the samples that satisfy (6), and what they come to.
struct LawRows {
  const IdentifierInput& input;
  const LinearTask& task;
  Eigen::MatrixXd A;       // [n x d]
  Eigen::VectorXd torque;  // [n] N.m or N
  RobustLeastSquares robust{};
  std::shared_ptr<const LaggedRows> lag{};       // of a torque that lags; or none
  std::shared_ptr<const Whitening> whitening{};  // of coloured noise; or none
  std::optional<Disagreement> structure{};       // why the rows were not whitened
};

LawRows SolveRows(const IdentifierInput& input, const LinearTask& task) {
  LawRows rows{input, task, Kept(task.columns, input.selection),
               Kept(input.measurements.torque, input.selection)};
  rows.robust = input.options.Get<LossOption>().loss == LossKind::huber
                    ? SolveHuber(rows.A, rows.torque)
                    : RobustLeastSquares{SolveLeastSquares(rows.A, rows.torque), kInfinity, true};
  return rows;
}

/// Once more behind the lag of the torque, where the log shows one.
void SolveBehindLag(LawRows& rows) {
  LeastSquares& solved = rows.robust.fit;
  const auto runs =
      std::make_shared<const KeptRuns>(FindRuns(rows.input.measurements, rows.input.selection));
  auto behind = FitLinearLag(runs, rows.A, rows.torque, rows.A * solved.solution);
  if (!behind) return;
  rows.lag = behind->rows;
  solved = std::move(behind->fit);
}

/// Once more on whitened rows, where the noise is coloured beyond doubt.
void SolveWhitened(LawRows& rows) {
  const auto& [input, task] = std::tie(rows.input, rows.task);
  LeastSquares& solved = rows.robust.fit;
  const auto whitening =
      WhiteningFor(rows.torque - rows.A * solved.solution, input.measurements, input.selection);
  if (!whitening) return;
  LeastSquares white = SolveLeastSquares(whitening->Of(rows.A), whitening->Of(rows.torque));
  if (white.rank < task.count()) return;

  // whitening stays where it changes no more than noise may, and leaves a friction
  rows.structure = FindStructure(rows.A, rows.torque, solved, white, *whitening, input.selection);
  const bool is_friction = !LeavesBounds(
      LawParameters(task.law, white.solution.head(task.law_count()), input.measurements));
  if (rows.structure || !is_friction) return;
  rows.whitening = whitening;
  solved = std::move(white);
}

/// The law, gravity beside it, and how well they fit.
Fit AsFit(const LawRows& rows) {
  const auto& [input, task] = std::tie(rows.input, rows.task);
  const Measurements& m = input.measurements;
  const LeastSquares& solved = rows.robust.fit;
  const Eigen::VectorXd values = solved.solution.head(task.law_count());
  Fit fit;
  fit.identifier = kName;
  fit.friction = FrictionOf(task.law, values, m);
  fit.parameters = LawParameters(task.law, values, m);
  AddRigid(task.gravity, solved.solution.tail(task.gravity.count()), m, fit);

  // how well they fit, and what their errors follow from
  fit.used = input.selection;
  fit.torque = rows.torque;
  fit.fitted = rows.A * solved.solution;
  fit.errors.cofactor = solved.cofactor;
  fit.errors.whitening = rows.whitening;
  fit.count = task.count();
  fit.effective_parameters = task.count();
  fit.summary = fmt::format("law {} by least squares on {} samples{}{}{}", task.law.name,
                            rows.torque.size(), m.acceleration ? kOfAnyMotion : "",
                            rows.lag ? kBehindLag : "", rows.whitening ? kWhitened : "");
  fit.jacobian = [all = task.columns] { return all; };
  return fit;
}

Fit FitLaw(const IdentifierInput& given) {
  if (auto why = WhyNoLag(given)) return Refused(kName, Status::bad_data, *why);
  const LinearTask task = BeginLinear(given, 0);
  if (task.refusal) return Refused(kName, *task.refusal);
  const IdentifierInput input = task.gravity.Of(given);

  // law and gravity on the rows as they are
  LawRows rows = SolveRows(input, task);
  const LeastSquares& solved = rows.robust.fit;
  if (solved.rank < task.count()) {
    return Refused(kName, Status::not_identifiable,
                   IndistinctColumns(solved.mixed, task.law, task.gravity, input));
  }
  if (!rows.robust.converged) {
    return Refused(kName, Status::not_converged,
                   "the weights of Huber's loss still move after 100 rounds; use loss squares");
  }

  // then behind a lag of the torque, or whitened where the noise is coloured
  const bool by_squares = std::isinf(rows.robust.threshold);
  if (AsksForLag(given.options)) SolveBehindLag(rows);
  if (by_squares && !rows.lag) SolveWhitened(rows);

  // what only some have
  Fit fit = AsFit(rows);
  if (!by_squares) {
    fit.errors.scores = HuberScores(fit.residual(), rows.robust.threshold);
    fit.loss_bend = rows.robust.threshold;
  }
  if (rows.structure) {
    const Eigen::Index count = task.law_count();
    fit.unmodelled_residual = {*rows.structure,
                               rows.A.leftCols(count) * solved.solution.head(count)};
  }
  if (rows.lag) AddLag(rows.lag, task.columns * solved.solution, input.measurements, fit);
  if (!rows.lag && AsksForLag(given.options)) fit.afterword = kNoLagSeen;
  return fit;
}

}  // namespace

Identifier NominalLs() {
  return {kName, "a nominal law by linear least squares, without warming",
          OptionGroups<LawOption, GravityOption, MotionOption, LossOption, LagOption>{}, &FitLaw};
}

}  // namespace warmjoint
