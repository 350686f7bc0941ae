// The answer after a list of causes was applied to it.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "identification/fit/cause.h"
#include "identification/inference/inference.h"

namespace warmjoint {

/// The only function that changes a value, an interval or the status. The order of the rows does not matter to any of
/// them: shifts and holds add up, widenings of intervals add up (ChangeOf), and of rows that refuse the one counts whose status
/// comes first in the order bad_data, inadequate_model, not_identifiable, not_converged. Sentences are in the order of their sources.
/// by_noise: the inference from the noise alone.
Inference Apply(Inference by_noise, std::vector<Cause> causes);

/// What the causes of an answer do to a figure that depends on its parameters, to first order.
struct FigureChange {
  double shift = 0;
  double reach = 0;  // by which either end of its interval is moved outwards
  /// how far below and above its value the true one may be, by rows that cover
  double below = 0, above = 0;
  bool has_interval = true;          // whether all that it depends on has one
  std::vector<WidthPart> parts{};    // of reach, by source
  std::vector<WidthPart> covered{};  // of below and above
};

/// The biases of one row act together, |d b| + 1.96 |d S|, up to the most that the row allows. Rows of one source are several
/// ways in which the same thing may be wrong, of which the worst counts. Different sources add up. causes: Inference::causes;
/// derivatives: [P] of the figure by the value of each row of the fit's table, a unit vector for one parameter; of: what the
/// figure is, `parameters` also for figures that are computed from them
FigureChange ChangeOf(const std::vector<Cause>& causes, const Eigen::VectorXd& derivatives,
                      About of);

/// The one rule by which a figure and its 95 % interval change: shift moves both, reach widens the interval at either end, and with
/// below and above it holds the true value for noise around any value of that range (ReachBeyondEnds). Returns what of the new
/// half width each source adds.
std::vector<WidthPart> Move(const FigureChange& change, double& value,
                            std::array<double, 2>& interval);

}  // namespace warmjoint
