#include "identification/holdout/hold_out.h"

#include <fmt/format.h>
#include <warmjoint/friction_model.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "identification/holdout/predict_torque.h"
#include "identification/inference/inference.h"
#include "identification/physical_bounds.h"
#include "identification/seen_samples.h"

namespace warmjoint {
namespace {

/// Why samples that were asked for are not compared.
std::string WhyNone(const Fit& fit, Eigen::Index asked) {
  if (asked > 0 && fit.gravity) return "the fit knows gravity at none of the places it reaches";
  return fit.inertia ? "no sample moves clearly" : "no sample moves at a constant speed";
}

/// Whether the heat with which recordings begin is free, so that a fit knows that of no recording that it has not seen.
bool HasOwnStarts(const Fit& fit, const LogSamples& measurements) {
  return fit.RowOf(Role::start) && !measurements.further_starts.empty();
}

}  // namespace

std::optional<FirstPart> FitFirstPart(const Identifier& identifier, const IdentifierInput& given,
                                      double fraction, const Fit& all_data) {
  const IdentifierInput input = SelectSamples(identifier, given);
  const auto& keep = input.selection.keep;
  // a share of the samples that take part, however long they last
  const auto first = std::llround((1 - fraction) * static_cast<double>(keep.count()));
  if (first < 2 || first >= keep.count()) return std::nullopt;
  Eigen::Index end = 0;
  for (Eigen::Index seen = 0; seen < first || !keep[end]; ++end) seen += keep[end];
  const double split = input.measurements.time[end];
  // what lies before, seen as the identifier saw the whole log
  const IdentifierInput before{input.log.Before(split), input.options, input.start};
  const IdentifierInput seen = before.Through(input.view);
  Fit fit = all_data.structure ? all_data.structure(seen) : identifier.fit(seen);
  return FirstPart{split, AtBounds(std::move(fit), seen.measurements)};
}

HeldOut HoldOut(const Identifier& identifier, const IdentifierInput& given, double fraction,
                const Fit& all_data) {
  const std::string part = fmt::format("the first {:.3g} % of the log", 100 * (1 - fraction));
  const auto first = FitFirstPart(identifier, given, fraction, all_data);
  if (!first) return {{}, fmt::format("{}, or the rest, hold fewer than two samples", part)};

  // the test part alone is compared, the prediction runs from the start
  const IdentifierInput input = SelectSamples(identifier, given);
  Selection test = input.selection;
  const auto before = (input.measurements.time.array() < first->split).count();
  test.keep.head(before) = false;
  const bool own_starts = HasOwnStarts(first->fit, input.measurements);
  if (own_starts) {
    const std::vector<Eigen::Index>& starts = input.measurements.further_starts;
    const auto unseen = std::ranges::lower_bound(starts, before);
    if (unseen != starts.end()) test.keep.tail(input.measurements.size() - *unseen) = false;
  }
  if (auto metrics = Evaluate(first->fit, input.measurements, test, first->fit.Start())) {
    return {std::move(metrics), ""};
  }

  // a fit without friction predicts nothing; else the rest holds no sample to compare
  const Inference inferred = Infer(first->fit);
  if (!inferred.gives_friction) {
    return {{}, fmt::format("a fit to {} gives no friction ({})", part, inferred.message)};
  }
  const std::string why = own_starts && test.keep.count() == 0
                              ? "each recording begins with a heat of its own"
                              : WhyNone(first->fit, test.keep.count());
  return {{}, fmt::format("of the last {:.3g} % of the log, {}", 100 * fraction, why)};
}

HeldOut HoldOut(const Identifier& identifier, const Fit& fit, const PreparedLog& other) {
  const ThermalStart cold;
  const LogView& seen = SeenByModel(fit.inertia, identifier.view, other);
  if (auto metrics = Evaluate(fit, seen.measurements, seen.selection, cold)) {
    return {std::move(metrics), ""};
  }
  if (!GivesFriction(fit)) return {{}, "the fit gives no friction that could predict them"};
  return {{},
          fmt::format("of {}, {}", seen.measurements.source, WhyNone(fit, seen.selection.count()))};
}

}  // namespace warmjoint
