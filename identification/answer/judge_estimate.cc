#include "identification/answer/judge_estimate.h"

#include <algorithm>

#include "identification/answer/own_misfit.h"
#include "identification/find_parameter.h"
#include "identification/fit_parameters.h"
#include "identification/lack_of_fit/judge.h"

namespace warmjoint {
namespace {

/// The fit that the estimate's friction stands for: a table of its law, heat and start.
Fit FitOf(const Estimate& estimate, const Measurements& m) {
  Fit fit;
  fit.identifier = estimate.identifier;
  fit.friction = *estimate.friction;
  fit.gravity = estimate.gravity;

  // the rows that a fit of that law would have
  const std::vector<double> values = LawValues(fit.friction);
  const Eigen::Map<const Eigen::VectorXd> law(values.data(),
                                              static_cast<Eigen::Index>(values.size()));
  fit.parameters = LawParameters(*FindLaw(fit.friction.law), law, m);

  // heat and start, where the estimate tells them
  if (fit.friction.thermal && Find(Role::heat, estimate)) {
    for (FitParameter& row : HeatParameters(*fit.friction.thermal, m)) {
      fit.parameters.push_back(std::move(row));
    }
  }
  if (const EstimatedParameter* start = Find(Role::start, estimate)) {
    fit.initial_energy = start->value;
    fit.parameters.push_back(StartParameter(start->value, m));
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

  // a row that the estimate does not tell keeps its value, without errors
  for (const FitParameter& row : fit.parameters) {
    const EstimatedParameter* one = estimate.Find(row.name);
    inference.parameters.push_back(one ? KnownParameter{one->value, one->std, one->interval95, 0}
                                       : KnownParameter{row.value, {}, {}, 0});
  }
  return inference;
}

/// Takes over what the verdict left.
void TakeOver(const Fit& fit, Inference inference, Estimate& estimate) {
  estimate.status = inference.status;
  estimate.message = std::move(inference.message);
  estimate.warnings = std::move(inference.warnings);
  estimate.diagnostics = std::move(inference.diagnostics);
  estimate.assumptions = std::move(inference.assumptions);
  if (!inference.gives_friction) estimate.friction.reset();
  for (size_t i = 0; i < fit.parameters.size(); ++i) {
    const auto one =
        std::ranges::find(estimate.parameters, fit.parameters[i].name, &EstimatedParameter::name);
    if (one == estimate.parameters.end()) continue;
    one->value = inference.parameters[i].value;
    one->std = inference.parameters[i].std;
    one->interval95 = inference.parameters[i].interval95;
  }
}

}  // namespace

void JudgeEstimate(const PreparedLog& log, const Judging& judging, Estimate& estimate) {
  // an identifier without options stands for whoever made the estimate
  const Identifier identifier{estimate.identifier, "", {}, nullptr};
  const IdentifierInput input{log, {}, {}};
  if (!estimate.friction) {
    // nothing to follow along the log
    Fit none;
    none.refusal = Refusal{estimate.status, "the estimate holds no friction"};
    Inference told;
    told.status = estimate.status;
    JudgeLackOfFit(identifier, input, none, judging, told);
    estimate.diagnostics = std::move(told.diagnostics);
    return;
  }
  const Fit fit = FitOf(estimate, input.measurements);
  Inference inference = InferenceOf(estimate, fit);
  // whether its own law could follow the log better, then what the law lacks
  const std::optional<std::string> misfit =
      OwnMisfit(fit, inference, input.measurements, input.selection, judging);
  JudgeLackOfFit(identifier, input, fit, judging, inference);
  if (misfit && inference.status == Status::ok) inference.Void(Status::inadequate_model, *misfit);
  TakeOver(fit, std::move(inference), estimate);
}

}  // namespace warmjoint
