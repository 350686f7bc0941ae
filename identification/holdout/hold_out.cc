#include "identification/holdout/hold_out.h"

#include "identification/holdout/evaluate.h"

namespace warmjoint::inline identification {
namespace {

/// Another log with the samples that the identifier learned from in `input`.
IdentifierInput SeenAs(const IdentifierInput& input, const Identifier& identifier,
                       const IdentifierInput& other) {
  if (input.measurements.acceleration) return other.Moving();
  return identifier.regime == Regime::transient ? other.AsTaken() : other;
}

}  // namespace

std::optional<Metrics> HoldOut(const Identifier& identifier, const IdentifierInput& given,
                               double fraction, const Fit& all_data) {
  // the first sample of the test part
  const IdentifierInput input = identifier.Seen(given);
  const Measurements& all = input.measurements;
  const double duration = all.time[all.size() - 1] - all.time[0];
  const double split = all.time[0] + (1 - fraction) * duration;
  const Eigen::Index n = (all.time.array() < split).count();
  if (n < 2) return std::nullopt;

  // fit on what lies before it, evaluate on the rest
  const IdentifierInput before{input.log.Before(split), input.options, input.start};
  const IdentifierInput seen = SeenAs(input, identifier, before);
  const Fit fit = all_data.structure ? all_data.structure(seen) : identifier.fit(seen);
  Selection test = input.selection;
  test.keep.head(n) = false;
  return Evaluate(fit, all, test, fit.Start());
}

std::optional<Metrics> HoldOut(const Identifier& identifier, const Fit& fit,
                               const PreparedLog& other) {
  const CourseStart cold;
  const LogView& seen = fit.inertia                              ? other.moving()
                        : identifier.regime == Regime::transient ? other.taken()
                                                                 : other.steady();
  return Evaluate(fit, seen.measurements, seen.selection, cold);
}

}  // namespace warmjoint::inline identification
