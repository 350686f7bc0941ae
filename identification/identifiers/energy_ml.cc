// Identifier `energy-ml`: law and warming together, by maximum likelihood over the closed loop (warming/fit_law.h).
// Needs no start. Any law that is linear in its parameters; optionally E(0). Where `position` names maps over the
// joint's or the motor's angle, these are fitted together with law and warming (maps/energy_ml_maps.h), but without a lag.
#include "identification/fields/fit_fields.h"
#include "identification/fit/seen_samples.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/lagged/lagged_fit.h"
#include "identification/linear/linear_laws.h"
#include "identification/linear/rigid_part.h"
#include "identification/maps/energy_ml_maps.h"
#include "identification/sentences/late_torque.h"
#include "identification/sentences/law.h"
#include "identification/warming/fit_law.h"
#include "identification/warming/initial_energy.h"
#include "identification/warming/load.h"
#include "identification/warming/torque_delay.h"

namespace warmjoint {
namespace {

constexpr const char* kEnergyMl = "energy-ml";

Fit FitAsAsked(const IdentifierInput& input) {
  if (input.options.Get<WarmMapOptions>().position == WarmMap::none) {
    return FitWithFields(input, [](const IdentifierInput& given) {
      return FitLaw(kEnergyMl, given, PartFit::estimated);
    });
  }
  // options that cannot be combined
  if (auto why = WhyNoLag(input)) return Refused(kEnergyMl, Status::bad_data, *why);
  if (AsksForLoad(input)) {
    return Refused(kEnergyMl, Status::bad_data, kLoadBesideMaps);
  }
  if (AsksForLag(input.options)) {
    return Refused(kEnergyMl, Status::bad_data, kLagBesideMaps);
  }
  return FitWithMaps(kEnergyMl, input);
}

}  // namespace

Identifier EnergyMl() {
  return {kEnergyMl,
          "law and warming together by maximum likelihood over the closed loop; needs no start",
          OptionGroups<LawOption, InitialEnergyOptions, GravityOption, LoadOption, MotionOption,
                       LossOption, LagOption, DelayOption, FieldOption, WarmMapOptions>{},
          &FitAsAsked};
}

}  // namespace warmjoint
