// What an ideal test of the torque could see of a model that is wrong.
#pragma once

#include <fmt/format.h>

#include <Eigen/QR>
#include <memory>
#include <string>
#include <vector>

#include "identification/fit_data.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/inference/inference.h"
#include "identification/lack_of_fit/fitted_model.h"
#include "scenarios/suite.h"
#include "sim/plant/plant.h"

namespace warmjoint {

/// Squares that the model of a fit leaves at least: plain least squares from where the fit ended, since
/// a whitened one leaves more. -1 where there is no fit.
inline double LeastSquaresOf(Fit fit, const Measurements& m, const Selection& selection) {
  constexpr int kSteps = 8;
  double least = -1;
  for (int step = 0; step < kSteps; ++step) {
    const std::optional<FittedModel> model = EvaluateModel(fit, Infer(fit), m, selection);
    if (!model || !model->residual.allFinite() || !model->derivatives.allFinite()) break;
    const Eigen::VectorXd residual = Kept(model->residual, model->selection);
    const Eigen::MatrixXd rows = Kept(model->derivatives, model->selection);
    const Eigen::VectorXd move = rows.colPivHouseholderQr().solve(residual);
    const double squares = (residual - rows * move).squaredNorm();
    if (least >= 0 && squares > least) break;
    least = squares;

    // from there on
    for (size_t i = 0; i < model->rows.size(); ++i) {
      FitParameter& row = fit.parameters[model->rows[i]];
      row.value += move[static_cast<Eigen::Index>(i)];
      if (row.role == Role::law) fit.friction.parameters[row.name] = row.value;
      if (row.name == "thermal_gain") fit.friction.thermal->gain = row.value;
      if (row.name == "thermal_time_constant") fit.friction.thermal->time_constant = row.value;
    }
  }
  return least;
}

/// Squares that an identifier's model leaves of the torque of a log without torque noise, over the
/// variance of the scenario's noise: "12, 14, 9" of three realizations, "-" where there is no fit.
/// Noise of other sensors stays. Below about 30 no test can see that the model is wrong.
inline std::string IdealChi2(const Scenario& scenario, const SuiteIdentifier& one) {
  constexpr std::uint64_t kLogs = 3;
  const double variance = scenario.noise.torque * scenario.noise.torque;
  if (!(variance > 0)) return "-";
  Scenario quiet = scenario;
  quiet.noise.torque = 0;
  const std::unique_ptr<Plant> plant = MakePlant(quiet);
  const Identifier& identifier = FindIdentifier(one.name);
  const Options options(identifier.options, one.options, {one.label});

  std::string texts;
  for (std::uint64_t r = 0; r < kLogs; ++r) {
    const PreparedLog log = Prepare(plant->Run(r).measurements);
    const IdentifierInput given{log, options, {}};
    const IdentifierInput input = identifier.Seen(given);
    const double squares =
        LeastSquaresOf(identifier.fit(input), input.measurements, input.selection);
    texts += fmt::format("{}{}", r == 0 ? "" : ", ",
                         squares >= 0 ? fmt::format("{:.3g}", squares / variance) : "-");
  }
  return texts;
}

}  // namespace warmjoint
