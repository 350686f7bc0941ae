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

std::optional<FirstPart> FitFirstPart(const Identifier& identifier, const IdentifierInput& given,
                                      double fraction, const Fit& all_data) {
  const IdentifierInput input = identifier.Seen(given);
  const Eigen::VectorXd& time = input.measurements.time;
  const double split = time[0] + (1 - fraction) * (time[time.size() - 1] - time[0]);
  if ((time.array() < split).count() < 2) return std::nullopt;
  const IdentifierInput before{input.log.Before(split), input.options, input.start};
  const IdentifierInput seen = SeenAs(input, identifier, before);
  return FirstPart{split, all_data.structure ? all_data.structure(seen) : identifier.fit(seen)};
}

std::optional<Metrics> HoldOut(const Identifier& identifier, const IdentifierInput& given,
                               double fraction, const Fit& all_data) {
  const auto first = FitFirstPart(identifier, given, fraction, all_data);
  if (!first) return std::nullopt;
  const IdentifierInput input = identifier.Seen(given);
  Selection test = input.selection;
  test.keep.head((input.measurements.time.array() < first->split).count()) = false;
  return Evaluate(first->fit, input.measurements, test, first->fit.Start());
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
