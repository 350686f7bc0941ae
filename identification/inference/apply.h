// What a list of causes leaves of an answer.
#pragma once

#include <cstddef>
#include <vector>

#include "identification/inference/cause.h"
#include "identification/inference/inference.h"

namespace warmjoint {

/// The only function that changes a value, an interval or the status. The order of the rows does not matter to any of
/// them: what shifts and holds adds, what widens intervals adds (ChangeOf), and of rows that refuse the one whose status says most counts, in the
/// order bad_data, inadequate_model, not_identifiable, not_converged. Sentences stand in the order of their sources.
/// by_noise: what noise alone says.
Inference Apply(Inference by_noise, std::vector<Cause> causes);

/// What the causes of an answer do to a figure that depends on its parameters, to first order.
struct FigureChange {
  double shift = 0;
  double reach = 0;                  // of either end of its interval
  double below = 0, above = 0;       // how far the value may lie from itself, of rows that cover
  bool has_interval = true;          // whether all that it depends on has one
  std::vector<WidthPart> parts{};    // of reach, by source
  std::vector<WidthPart> covered{};  // of below and above

  /// Of the end that moves farthest, at most.
  double Reach() const { return reach + below + above; }
};

/// Each row's biases act together, |d b| + 1.96 |d S|, within what it allows at most. Rows of one source are several ways in which the same may be wrong, of
/// which the worst counts; sources add. causes: Inference::causes; derivatives: [P] of the figure by the value of each row of
/// the fit's table, a unit vector for one parameter; of: what the figure is, parameters also for what is made of them
FigureChange ChangeOf(const std::vector<Cause>& causes, const Eigen::VectorXd& derivatives,
                      About of);

}  // namespace warmjoint
