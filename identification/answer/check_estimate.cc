#include "identification/answer/check_estimate.h"

#include <algorithm>
#include <optional>

#include "identification/fit/fit_along.h"
#include "identification/fit/fit_data.h"
#include "identification/fit/fit_parameters.h"
#include "identification/forward/log_trajectory.h"
#include "identification/inference/apply.h"
#include "identification/lack_of_fit/find_lack_of_fit.h"
#include "identification/lack_of_fit/fitted_model.h"
#include "identification/lack_of_fit/significance.h"
#include "identification/model/least_squares.h"
#include "identification/report/report_fit.h"
#include "identification/sentences/assumptions.h"
#include "identification/sentences/friction.h"
#include "identification/uncertainty/tails.h"

namespace warmjoint {
namespace {

/// A fit with the estimate's friction: a table of its law, heat and start.
Fit FitOf(const Estimate& estimate, const LogSamples& m) {
  Fit fit;
  fit.identifier = estimate.identifier;
  fit.model.friction = *estimate.friction;
  fit.model.gravity = estimate.gravity;

  // the rows that a fit of that law would have, of which that of the load needs a load
  std::vector<double> values = LawValues(fit.model.friction);
  const bool carries = m.load || estimate.gravity;
  if (carries && estimate.Find(NameOf(Role::load))) values.push_back(fit.model.friction.load_gain);
  const Eigen::Map<const Eigen::VectorXd> law(values.data(), std::ssize(values));
  fit.parameters =
      WithValues(LawUnknowns(*FindLaw(fit.model.friction.law), law.size(), UnitsOf(m)), law);

  // heat and start, where the estimate has them
  if (fit.model.friction.thermal && Find(Role::gain, estimate)) {
    Append(HeatParameters(*fit.model.friction.thermal, m), fit);
  }
  if (const EstimatedParameter* start = Find(Role::start, estimate)) {
    fit.start.energy = start->value;
    fit.parameters.push_back(WithValue(StartUnknown(UnitsOf(m)), start->value));
  }
  return fit;
}

/// What the estimate claims of each row.
Inference InferenceOf(const Estimate& estimate, const Fit& fit) {
  Inference inference;
  inference.status = estimate.status;
  inference.message = estimate.message;
  inference.warnings = estimate.warnings;
  inference.gives_friction = true;

  // a row that the estimate lacks keeps its value, without errors
  for (const Unknown& row : fit.parameters) {
    const EstimatedParameter* one = estimate.Find(row.name);
    inference.parameters.push_back(one ? ParameterInterval{one->value, one->std, one->interval95}
                                       : ParameterInterval{row.value, {}, {}});
  }
  return inference;
}

/// Writes the verdict into an estimate. What is not in the fit's table is of the other program and is kept: numbers of its own,
/// the discrete pair, its metrics and its trace.
void ReportCheck(const Fit& fit, const Inference& inference, Estimate& estimate) {
  ReportVerdict(inference, estimate);
  // the numbers that others would use
  if (inference.gives_friction) {
    estimate.friction = ReportedFriction(fit, inference);
  } else {
    estimate.friction.reset();
    estimate.covariance.reset();
    estimate.bands.clear();
    estimate.friction_at_speeds.clear();
    estimate.state_end.clear();
  }
  for (size_t i = 0; i < fit.parameters.size(); ++i) {
    const auto one =
        std::ranges::find(estimate.parameters, fit.parameters[i].name, &EstimatedParameter::name);
    if (one == estimate.parameters.end()) continue;
    one->value = inference.parameters[i].value;
    one->std = inference.parameters[i].std;
    one->interval95 = inference.parameters[i].interval95;
  }
}

/// The tests for lack of fit look for structure that a law cannot follow, since a least-squares fit leaves none that
/// its law could follow. The estimate of another program may leave some: one Gauss-Newton step d of its parameters, over its
/// residual, shows what the same law would take up. Returns a row that refuses the estimate where J d is relevant (judging) and
/// a part of d is beyond noise: of p parameters, at an error level of 1 % for all (Bonferroni). inference: of
/// the fit; selection: samples at constant speed.
std::optional<Cause> OwnLawCause(const Fit& fit, const Inference& inference,
                                 const LogSamples& measurements, const Selection& selection,
                                 const LackOfFitSettings& judging) {
  const std::optional<FittedModel> model = EvaluateModel(fit, inference, measurements, selection);
  if (!model || !model->residual.allFinite() || !model->derivatives.allFinite())
    return std::nullopt;

  // one step from the estimate
  const auto p = static_cast<Eigen::Index>(model->rows.size());
  const Eigen::MatrixXd rows = Kept(model->derivatives.leftCols(p), model->selection);
  const Eigen::VectorXd residual = Kept(model->residual, model->selection);
  if (p == 0 || rows.rows() <= p) return std::nullopt;
  const LeastSquares step = SolveLeastSquares(rows, residual, 0);
  if (step.rank < p) return std::nullopt;

  // whether that matters
  const Eigen::VectorXd taken = rows * step.solution;
  if (taken.norm() < judging.relevance * Kept(model->torque, model->selection).norm()) {
    return std::nullopt;
  }

  // and whether that may be noise
  const Uncertainty uncertainty = CovarianceOf({.rows = RowsFrom([&] { return rows; }),
                                                .cofactor = step.cofactor,
                                                .residual = residual - taken,
                                                .selection = model->selection});
  // the parameter with the largest change, in its standard errors
  const Eigen::ArrayXd deviations = uncertainty.covariance.diagonal().array().sqrt();
  Eigen::Index most = 0;
  const double z = (step.solution.array().abs() / deviations).maxCoeff(&most);
  if (static_cast<double>(p) * PValueOfStudent(z, uncertainty.degrees_of_freedom) >= kErrorLevel) {
    return std::nullopt;
  }

  const Unknown& parameter = fit.parameters[model->rows[static_cast<std::size_t>(most)]];
  return Cause{.source = Source::own_law,
               .action = Action::refuse,
               .status = Status::inadequate_model,
               .sentence = ExplainOwnLaw({parameter, step.solution[most]})};
}

}  // namespace

void CheckEstimate(const PreparedLog& log, const LackOfFitSettings& judging, Estimate& estimate) {
  // an identifier without options takes the place of the one that made the estimate
  const Identifier identifier{estimate.identifier, "", {}, nullptr};
  const IdentifierInput given{log, {}, {}};
  if (!estimate.friction) {
    // without a friction there is nothing to compare with the log
    Fit none;
    none.refusal = Refusal{estimate.status, kHoldsNoFriction};
    Inference told;
    told.status = estimate.status;
    estimate.diagnostics = FindLackOfFit(identifier, given, none, told, {}, judging).diagnostics;
    return;
  }
  const Fit fit = FitOf(estimate, given.measurements);
  const auto followed = Followed(given.measurements, given.selection, PartsOf(fit));
  const IdentifierInput input = followed ? given.On(*followed) : given;
  const Inference claimed = InferenceOf(estimate, fit);
  // the lack of fit of the law, and whether the same law with other parameters could follow the log better
  std::optional<FittedModel> model;
  if (claimed.status == Status::ok) {
    model = EvaluateModel(fit, claimed, input.measurements, input.selection);
  }
  auto [diagnostics, causes] = FindLackOfFit(identifier, input, fit, claimed, model, judging);
  if (claimed.status == Status::ok && !IsRefused(causes)) {
    auto misfit = OwnLawCause(fit, claimed, input.measurements, input.selection, judging);
    if (misfit) causes.push_back(std::move(*misfit));
  }
  Inference judged = Apply(claimed, causes);
  judged.diagnostics = std::move(diagnostics);
  judged.assumptions = AssumptionsOf(causes, fit, input.measurements.torque_unit);
  ReportCheck(fit, judged, estimate);
}

}  // namespace warmjoint
