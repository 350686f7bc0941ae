#include "identification/seen_samples.h"

#include "identification/preparation/moving_view.h"

namespace warmjoint::inline identification {

IdentifierInput Seen(const Identifier& identifier, const IdentifierInput& input) {
  // of a whole log, what is absurd pulls no less at a loss that bounds its pull than others do
  const bool is_bounded = identifier.Has("loss") && input.options.Text("loss") == "huber";
  const PreparedLog& bounded = is_bounded ? input.log.WithoutAbsurd() : input.log;
  if (&bounded != &input.log && &input.selection == &input.log.steady().selection) {
    return Seen(identifier, {bounded, input.options, input.start, input.narrator});
  }

  if (identifier.regime == Regime::transient) return input.AsTaken();
  if (!identifier.Has("motion")) return input;
  const std::string& motion = input.options.Text("motion");
  const bool any = motion == "any" || (motion == "chosen" && !HoldsSpeeds(input.log));
  return any ? input.On(MovingView(input.log)) : input;
}

}  // namespace warmjoint::inline identification
