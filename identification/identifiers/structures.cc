#include "identification/identifiers/structures.h"

#include <fmt/format.h>

#include <initializer_list>

#include "identification/holdout/blocked_hold_out.h"
#include "identification/identifiers/energy_ml_with_maps.h"
#include "identification/identifiers/motor_ridge.h"
#include "identification/identifiers/nominal_ls.h"
#include "identification/identifiers/position_ridge.h"
#include "identification/identifiers/stribeck.h"
#include "identification/lagged/lagged_fit.h"
#include "identification/linear/rigid_part.h"
#include "identification/read_options.h"
#include "identification/warming/expected_start.h"
#include "models/friction/asymmetric_stribeck.h"
#include "models/recording/measurements.h"

namespace warmjoint::inline identification {

std::string Structure::Name() const {
  std::string name = identifier.name;
  for (const auto& [key, value] : given) name += fmt::format(" {}={}", key, value);
  return name;
}

std::string Structure::Given(const std::string& option, const std::string& otherwise) const {
  const auto found = given.find(option);
  return found == given.end() ? otherwise : found->second;
}

Structure Structure::With(const std::string& option, const std::string& value) const {
  Structure other = *this;
  other.given[option] = value;
  return other;
}

Structure Structure::WithShapeOf(const FrictionMap& map) const {
  const MapAxis& axis = map.axes[0];
  const std::vector<double>& centres = axis.kernels.centres;
  const double spacing = centres[1] - centres[0];
  const Structure wide = With("width", fmt::format("{:.4g}", axis.kernels.width / spacing));
  // over the motor's angle only the width is chosen
  if (axis.quantity != MapQuantity::position) return wide;
  return wide.With("kernels", std::to_string(centres.size()));
}

bool Structure::CanTellLag() const {
  return TellsLag(identifier) && Given("position", "none") == "none";
}

Structure Structure::Quick() const {
  const Structure sketch = Sketch();
  return strength ? sketch.With("strength", fmt::format("{}", *strength)) : sketch;
}

Options Structure::OptionsBeside(const Options& input) const {
  auto all = given;
  if (TellsStart(identifier)) all.merge(StartAsGiven(input));
  return ReadOptions(identifier.options, all, {});
}

Fit Structure::Fitted(const IdentifierInput& input) const {
  const Options options = OptionsBeside(input.options);
  return identifier.fit(input.With(options));
}

std::optional<Eigen::VectorXd> Structure::ErrorsOn(const IdentifierInput& input,
                                                   const std::vector<Eigen::Index>& bounds) const {
  const Options options = Quick().OptionsBeside(input.options);
  return BlockedErrors(identifier, input.With(options), bounds);
}

std::vector<std::string> GravityKinds(const IdentifierInput& input) {
  const std::string& asked = input.options.Text(kGravityOption);
  if (asked != "chosen") return {asked};
  // a place that never changes tells nothing of gravity
  const Eigen::VectorXd& position = input.measurements.position;
  if (!position.allFinite() || position.maxCoeff() == position.minCoeff()) return {"none"};
  if (input.measurements.joint == JointKind::linear) return {"none", "paired"};
  return {"none", "sincos", "paired"};
}

namespace {

/// Linear laws by one identifier.
std::vector<Structure> LinearStructures(const Identifier& identifier, const std::string& gravity,
                                        std::initializer_list<const char*> laws) {
  std::vector<Structure> structures;
  for (const char* law : laws) {
    const Structure one{identifier, {{"law", law}}};
    structures.push_back(gravity == "none" ? one : one.With(kGravityOption, gravity));
  }
  return structures;
}

}  // namespace

std::vector<Structure> ColdStructures(const std::string& gravity) {
  return LinearStructures(NominalLs(), gravity, {"viscous_coulomb", "coulomb", "asymmetric"});
}

std::vector<Structure> WarmStructures(const std::string& gravity) {
  return LinearStructures(EnergyMlWithMaps(), gravity,
                          {"coulomb", "viscous_coulomb", "asymmetric"});
}

Structure StribeckStructure(const std::string& warming) {
  return {StribeckIdentifier(), {{"warming", warming}}};
}

Structure TwoLevelStribeckStructure(const std::string& warming) {
  return StribeckStructure(warming).With("law", std::string(AsymmetricStribeck::name));
}

std::vector<Structure> MapStructures(const IdentifierInput& input, const std::string& gravity,
                                     const ChosenKernels& kernels) {
  // with the kernels and the strength that were chosen for the log, if any
  const auto shaped = [](Structure one, const std::optional<ChosenMap>& chosen) {
    if (!chosen) return one;
    one.strength = chosen->strength;
    return one.WithShapeOf(chosen->map);
  };
  // what looks like gravity beside a law that is too simple may be a map's
  std::vector<std::string> kinds{"none"};
  if (gravity != "none") kinds.push_back(gravity);

  std::vector<Structure> structures;
  const bool knows_motor = KnowsMotorAngle(input.measurements);
  for (const std::string& kind : kinds) {
    std::map<std::string, std::string> given;
    if (kind != "none") given = {{kGravityOption, kind}};
    const Structure warm{EnergyMlWithMaps(), given};
    structures.push_back(shaped({PositionRidge(), given}, kernels.position));
    structures.push_back(shaped(warm.With("position", "map"), kernels.position));
    // ripple of the motor, where its angle is known
    if (!knows_motor) continue;
    structures.push_back(shaped({MotorRidge(), given}, kernels.motor));
    structures.push_back(shaped(warm.With("position", "motor"), kernels.motor));
  }
  return structures;
}

}  // namespace warmjoint::inline identification
