#include "identification/describe_friction.h"

#include <fmt/format.h>

#include "identification/fit_data.h"

namespace warmjoint::inline identification {
namespace {

/// A parameter beside the bound that its value lies outside of.
struct Excess {
  const EstimatedParameter& parameter;
  double bound = 0;
  bool below = false;   // the bound; else above
  bool beyond = false;  // with its whole 95 % interval
};

std::optional<Excess> FindExcess(const ParameterInfo& info, const EstimatedParameter& parameter) {
  const bool below = !(parameter.value >= info.lower);
  if (!below && parameter.value <= info.upper) return std::nullopt;
  const double bound = below ? info.lower : info.upper;
  const auto& interval = parameter.interval95;
  const bool beyond = interval && (below ? (*interval)[1] < bound : (*interval)[0] > bound);
  return Excess{parameter, bound, below, beyond};
}

/// "viscous is -0.3 N.m.s/rad, below its bound 0, with its whole 95 % interval, -0.4 to -0.2".
std::string Words(const Excess& excess) {
  const auto& [name, value, unit, std, interval] = excess.parameter;
  const std::string reach =
      !interval ? ", with no interval that could tell whether by chance"
                : fmt::format(", {} 95 % interval, {:.3g} to {:.3g}",
                              excess.beyond ? "with its whole" : "but for a part of its",
                              (*interval)[0], (*interval)[1]);
  return fmt::format("{} is {:.4g} {}, {} its bound {}{}", name, value, unit,
                     excess.below ? "below" : "above", excess.bound, reach);
}

/// What makes a fit leave its bounds, and what to try.
std::string_view Remedy(const EstimatedParameter& parameter) {
  if (parameter.name == "viscous") {
    return "friction that falls with speed is a Stribeck effect or warming: try stribeck or "
           "energy-ml";
  }
  if (parameter.name.starts_with("coulomb")) {
    return "a level that pushes is no friction: is a load, as gravity, in the torque (try "
           "--gravity), or is its sign reversed?";
  }
  return "try another law";
}

/// Whether the estimate's static level is below its Coulomb level, both being given.
bool RisesFromRest(const Estimate& estimate) {
  const EstimatedParameter* at_rest = estimate.Find("static");
  const EstimatedParameter* coulomb = estimate.Find("coulomb");
  return at_rest && coulomb && at_rest->value < coulomb->value;
}

}  // namespace

void DescribeFriction(const Law& law, const Measurements& measurements, Estimate& estimate) {
  FrictionDescription friction;
  friction.law = law.name;
  friction.gear = measurements.gear;
  std::vector<Excess> excesses;
  for (const ParameterInfo& info : law.parameters) {
    const EstimatedParameter& found = *estimate.Find(info.name);
    friction.parameters[found.name] = found.value;
    if (auto excess = FindExcess(info, found)) excesses.push_back(*excess);
  }

  for (const Excess& excess : excesses) {
    if (!excess.beyond) continue;
    Void(Status::inadequate_model,
         fmt::format("{}: law {} does not describe these data; {}", Words(excess), law.name,
                     Remedy(excess.parameter)),
         estimate);
    return;
  }
  if (RisesFromRest(estimate)) {
    Void(Status::inadequate_model,
         fmt::format("static is below coulomb: friction rises from rest with speed, where law {} "
                     "lets it fall; try law viscous_coulomb, or another",
                     law.name),
         estimate);
    return;
  }
  for (const Excess& excess : excesses) {
    estimate.warnings.push_back(
        fmt::format("{}: no friction is given; record longer{}", Words(excess),
                    excess.parameter.name == "viscous" ? ", or try law coulomb" : ""));
  }
  if (excesses.empty()) estimate.friction = friction;
}

}  // namespace warmjoint::inline identification
