// What a list of causes leaves of an answer.
#pragma once

#include <cstddef>
#include <vector>

#include "identification/inference/cause.h"
#include "identification/inference/inference.h"

namespace warmjoint {

/// The only function that changes a value, an interval or the status. The order of the rows does not matter to any of
/// them: shifts add, what widens intervals adds, and of rows that refuse the one whose status says most counts, in the order
/// bad_data, inadequate_model, not_identifiable, not_converged. Sentences stand in the order of their sources.
/// by_noise: what noise alone says.
Inference Apply(Inference by_noise, std::vector<Cause> causes);

/// How much farther a cause lets either end of the interval of its i-th row reach, 0 of one that does not widen.
double ReachOf(const Cause& cause, std::size_t i);

/// What the causes of an answer do to a figure that depends on its parameters, to first order.
struct FigureChange {
  double shift = 0;
  double reach = 0;  // of either end of its interval
};

/// Each row's biases act together, |d b| + 1.96 |d s|; rows add. causes: Inference::causes; derivatives: [P] of the figure by
/// the value of each row of the fit's table
FigureChange ChangeOf(const std::vector<Cause>& causes, const Eigen::VectorXd& derivatives);

}  // namespace warmjoint
