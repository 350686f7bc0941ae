#include "identification/seen_samples.h"

#include "identification/preparation/moving_view.h"

namespace warmjoint {

IdentifierInput SelectSamples(const Identifier& identifier, const IdentifierInput& input) {
  // of a whole log, what is absurd pulls no less at a loss that bounds its pull than others do
  const auto* loss = input.options.Find<LossOption>();
  const bool is_bounded = loss && loss->loss == LossKind::huber;
  const PreparedLog& bounded = is_bounded ? input.log.WithoutAbsurd() : input.log;
  if (&bounded != &input.log && &input.selection == &input.log.constant_speed().selection) {
    return SelectSamples(identifier, {bounded, input.options, input.start, input.narrator});
  }

  if (identifier.regime == Regime::transient) return input.AsTaken();
  const auto* asked = input.options.Find<MotionOption>();
  if (!asked) return input;
  const bool any = asked->motion == MotionKind::any ||
                   (asked->motion == MotionKind::chosen && !HoldsSpeeds(input.log));
  return any ? input.On(MovingView(input.log)) : input;
}

}  // namespace warmjoint
