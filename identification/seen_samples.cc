#include "identification/seen_samples.h"

#include "identification/preparation/moving_view.h"

namespace warmjoint::inline identification {

IdentifierInput Seen(const Identifier& identifier, const IdentifierInput& input) {
  if (identifier.regime == Regime::transient) return input.AsTaken();
  if (!identifier.Has("motion")) return input;
  const std::string& motion = input.options.Text("motion");
  const bool any = motion == "any" || (motion == "chosen" && !HoldsSpeeds(input.log));
  return any ? input.On(MovingView(input.log)) : input;
}

}  // namespace warmjoint::inline identification
