#include "identification/identifiers/energy_ml_with_maps.h"

#include "identification/identifiers/energy_ml_behind_lag.h"
#include "identification/lagged/lagged_fit.h"
#include "identification/maps/energy_ml_maps.h"

namespace warmjoint::inline identification {
namespace {

/// Without maps.
const Identifier& Plain() {
  static const Identifier plain = EnergyMlBehindLag();
  return plain;
}

Fit FitAsAsked(const IdentifierInput& input) {
  if (input.options.Text("position") == "none") return Plain().fit(input);

  // what maps cannot have beside them
  if (auto why = WhyNoLag(input)) return Refused(Plain().name, Status::bad_data, *why);
  if (AsksForLag(input)) {
    return Refused(Plain().name, Status::bad_data,
                   "torque_lag is estimated beside a law without maps; use position none, or "
                   "torque_lag none");
  }
  return FitWithMaps(Plain().name, input);
}

}  // namespace

Identifier EnergyMlWithMaps() {
  Identifier identifier = Plain();
  for (const OptionInfo& option : WarmMapOptions()) identifier.options.push_back(option);
  identifier.fit = &FitAsAsked;
  return identifier;
}

}  // namespace warmjoint::inline identification
