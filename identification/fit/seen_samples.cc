#include "identification/fit/seen_samples.h"

namespace warmjoint {
namespace {

View ViewFor(const Identifier& identifier, const IdentifierInput& input) {
  const auto* asked = input.options.Find<MotionOption>();
  if (!asked || identifier.view != View::constant_speed) return identifier.view;
  const bool any = asked->motion == MotionKind::any ||
                   (asked->motion == MotionKind::chosen && !input.log.holds_speeds());
  return any ? View::moving : View::constant_speed;
}

}  // namespace

Options WithoutInertia(const Options& options) {
  const auto* given = options.Find<MotionOption>();
  if (!given) return options;
  MotionOption without = *given;
  without.inertia = PartFit::none;
  return options.With(without);
}

const LogView& SeenThrough(View view, const PreparedLog& log) {
  switch (view) {
    case View::raw:
      return log.raw();
    case View::moving:
      return log.moving();
    case View::constant_speed:
      break;
  }
  return log.constant_speed();
}

IdentifierInput SelectSamples(const Identifier& identifier, const IdentifierInput& input) {
  // where the loss bounds the influence of a sample, an absurd one still has as much influence as others, so it is left out of a whole log
  const bool is_bounded = input.options.OrDefault<LossOption>().loss == LossKind::huber;
  const PreparedLog& bounded = is_bounded ? input.log.WithoutAbsurd() : input.log;
  if (&bounded != &input.log && &input.selection == &input.log.constant_speed().selection) {
    return SelectSamples(identifier, {bounded, input.options, input.start, input.narrator});
  }

  const View view = ViewFor(identifier, input);
  // samples that were chosen from the view stay chosen
  return view == input.view ? input : input.Through(view);
}

const LogView& SeenByModel(const std::optional<double>& inertia, View otherwise,
                           const PreparedLog& log) {
  return SeenThrough(inertia ? View::moving : otherwise, log);
}

}  // namespace warmjoint
