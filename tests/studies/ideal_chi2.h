// What an ideal test of the torque could see of a model that is wrong.
#pragma once

#include <warmjoint/prepared_log.h>

#include <Eigen/QR>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>

#include "identification/fit_data.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/inference/inference.h"
#include "identification/lack_of_fit/fitted_model.h"
#include "identification/seen_samples.h"
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

/// What an identifier's model leaves of the torque of logs without torque noise.
class IdealChi2 {
 public:
  explicit IdealChi2(const Scenario& scenario) : variance_(std::pow(scenario.noise.torque, 2)) {
    Scenario quiet = scenario;
    quiet.noise.torque = 0;
    if (variance_ > 0) plant_ = MakePlant(quiet);
  }

  /// Squares over the variance of the scenario's noise, of one realization; nothing where there is no fit or no
  /// noise. Noise of other sensors stays. Below about 30 no test can see that the model is wrong.
  std::optional<double> Of(const SuiteIdentifier& one, std::uint64_t realization) const {
    if (!plant_) return {};
    const Identifier& identifier = FindIdentifier(one.name);
    const PreparedLog log = Prepare(plant_->Run(realization).measurements);
    const IdentifierInput given{log, identifier.options.Read(one.options, {one.label}), {}};
    const IdentifierInput input = SelectSamples(identifier, given);
    const double squares =
        LeastSquaresOf(identifier.fit(input), input.measurements, input.selection);
    if (squares < 0) return {};
    return squares / variance_;
  }

 private:
  double variance_;
  std::unique_ptr<Plant> plant_;
};

}  // namespace warmjoint
