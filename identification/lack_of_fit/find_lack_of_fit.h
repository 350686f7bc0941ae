// Whether a model is adequate: what the residual of its fit still shows, as rows (Cause).
#pragma once

#include <warmjoint/estimate.h>

#include <optional>
#include <vector>

#include "identification/fit/cause.h"
#include "identification/fit/identifier.h"
#include "identification/inference/inference.h"
#include "identification/lack_of_fit/fitted_model.h"

namespace warmjoint {

/// How strict a verdict is, and what it takes for granted.
struct LackOfFitSettings {
  /// Change of the friction of law and heat by what was found (Harm), rms as a share of the friction's, from
  /// which a model is refused. A smaller one widens the intervals. 0 < relevance <= 1.
  double relevance = kDefaultRelevance;
  StartBelief start = StartBelief::cold;
};

struct LackOfFit {
  std::vector<Diagnostic> diagnostics;  // of every test
  std::vector<Cause> causes;
};

/// Examines a fit by the table of tests for lack of fit (table.h), made at one error level for the log
/// (significance.h). What they find is relevant where one finding changes the friction of law and heat by
/// more than the share `judging.relevance` of its rms over the kept samples (Harm), or where all together
/// amount to a quarter of it. Then a row refuses the answer, inadequate_model, and names what the
/// residual depends on and what to try. Where the change is smaller, a row widens the intervals by
/// what the parameters would change if the features were part of the model. No interval of the warming is given where there is
/// lack of fit over time or energy, since it is uncertain how much of that the warming took up. Where a start that is taken to
/// be cold matters, a row says how much. Noise that is coloured is no lack of fit: the intervals account for it.
/// Of a fit that is not ok no test is made. input: what the identifier saw; by_noise: what noise says of the fit, with the friction at
/// speeds, by which a sentence says how much findings change it; model: EvaluateModel of these.
LackOfFit FindLackOfFit(const Identifier& identifier, const IdentifierInput& input, const Fit& fit,
                        const Inference& by_noise, const std::optional<FittedModel>& model,
                        const LackOfFitSettings& judging);

}  // namespace warmjoint
