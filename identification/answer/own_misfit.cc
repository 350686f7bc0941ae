#include "identification/answer/own_misfit.h"

#include <fmt/format.h>

#include <cmath>

#include "identification/fit_data.h"
#include "identification/lack_of_fit/error_level.h"
#include "identification/lack_of_fit/fitted_model.h"
#include "identification/linear/least_squares.h"
#include "identification/uncertainty/tails.h"

namespace warmjoint {

std::optional<std::string> OwnMisfit(const Fit& fit, const Inference& inference,
                                     const Measurements& measurements, const Selection& selection,
                                     const Judging& judging) {
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

  // and whether noise may do it
  const Uncertainty known =
      JudgeUncertainty(rows, step.cofactor, residual - taken, model->selection);
  // the parameter that is farthest off, in its standard errors
  Eigen::Index most = 0;
  for (Eigen::Index j = 1; j < p; ++j) {
    const auto score = [&](Eigen::Index i) {
      return std::abs(step.solution[i]) / known.Deviation(i);
    };
    if (score(j) > score(most)) most = j;
  }
  const double z = std::abs(step.solution[most]) / known.Deviation(most);
  if (static_cast<double>(p) * PValueOfStudent(z, known.freedom) >= kErrorLevel) {
    return std::nullopt;
  }

  const FitParameter& parameter = fit.parameters[model->rows[static_cast<std::size_t>(most)]];
  return fmt::format(
      "the estimate does not fit its log: the same law fits it better with {} changed by {:.3g} "
      "{}; fit again, and check units, signs and the samples that were used",
      parameter.name, step.solution[most], parameter.unit);
}

}  // namespace warmjoint
