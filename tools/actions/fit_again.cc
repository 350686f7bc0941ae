#include "tools/actions/fit_again.h"

#include <algorithm>

#include "identification/answer/identify.h"
#include "identification/holdout/hold_out.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/preparation/moving_view.h"
#include "identification/read_options.h"
#include "identification/report/report_fit.h"
#include "identification/seen_samples.h"

namespace warmjoint::inline tools {
namespace {

/// What made an estimate.
struct Maker {
  const Identifier& identifier;
  Options options;
};

/// Nothing where the identifier is none of ours.
std::optional<Maker> MakerOf(const Estimate& estimate) {
  const Identifier* found = LookUpIdentifier(estimate.identifier);
  if (!found) return std::nullopt;
  return Maker{*found, ReadOptions(found->options, estimate.options, {"options of the estimate"})};
}

}  // namespace

Estimate WithFitAgain(Estimate estimate, const PreparedLog& log) {
  if (estimate.friction) return estimate;
  const std::optional<Maker> maker = MakerOf(estimate);
  if (!maker) return estimate;
  Estimate fit = IdentifyUnjudged(maker->identifier, {log, maker->options, {}});
  estimate.parameters = std::move(fit.parameters);
  estimate.friction = std::move(fit.friction);
  estimate.gravity = std::move(fit.gravity);
  estimate.bands = std::move(fit.bands);
  return estimate;
}

std::optional<HeldOutFit> FitFirstPartAgain(const Estimate& estimate, const PreparedLog& log,
                                            double fraction) {
  const std::optional<Maker> maker = MakerOf(estimate);
  if (!maker) return std::nullopt;
  const auto& [identifier, options] = *maker;
  const IdentifierInput input{log, options, {}};

  // one that chooses a structure has chosen it on all samples
  const Fit all_data = estimate.choice ? identifier.fit(Seen(identifier, input)) : Fit{};
  const auto first = FitFirstPart(identifier, input, fraction, all_data);
  if (!first) return std::nullopt;
  // the fit to the first part as an estimate of its own
  const PreparedLog seen = log.Before(first->split);
  const LogView& fitted = first->fit.inertia ? MovingView(seen) : seen.steady();
  HeldOutFit made{first->split, ReportFit(first->fit, Infer(first->fit), fitted.measurements)};
  if (!made.estimate.friction) return std::nullopt;
  made.estimate.status = estimate.status;
  return made;
}

}  // namespace warmjoint::inline tools
