#include "identification/identifiers/structures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <map>

#include "identification/fit/fit_data.h"
#include "identification/fit/seen_samples.h"
#include "identification/holdout/hold_out.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/lagged/lag_search.h"
#include "identification/lagged/lagged_fit.h"
#include "identification/lagged/lagged_rows.h"
#include "identification/linear/linear_laws.h"
#include "identification/warming/initial_energy.h"
#include "identification/warming/torque_delay.h"
#include "models/friction/laws.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

/// Linear laws by one identifier.
std::vector<Structure> LinearStructures(const Identifier& identifier, FittedGravity gravity,
                                        std::initializer_list<std::string_view> laws) {
  std::vector<Structure> structures;
  for (const std::string_view law : laws) {
    structures.push_back(
        Structure{identifier, "law"}.With(LawOption{{FindLaw(law)}}).With(GravityOption{gravity}));
  }
  return structures;
}

constexpr double kSettledAfter = 5;  // time constants; why 5: e^-5 = 1/150 is left

}  // namespace

std::string Structure::Name() const {
  // by name: the options that are not at their defaults, and the one that distinguishes it from others
  std::map<std::string, std::string> given = identifier.options.Changed();
  for (const OptionInfo& option : identifier.options.List()) {
    if (option.name == named_option) given.insert({option.name, option.value});
  }
  std::string name = identifier.name;
  for (const auto& [key, value] : given) name += fmt::format(" {}={}", key, value);
  return name;
}

FittedGravity Structure::gravity() const {
  return identifier.options.OrDefault<GravityOption>().gravity;
}

Structure Structure::WithShapeOf(const FrictionMap& map) const {
  const MapAxis& axis = map.axes[0];
  const std::vector<double>& centres = axis.kernels.centres;
  const double spacing = centres[1] - centres[0];
  auto made = identifier.options.Get<MapOptions>();
  made.width = std::round(1e4 * axis.kernels.width / spacing) / 1e4;
  const Structure wide = With(made);
  // over the motor's angle only the width is chosen
  if (axis.quantity != MapQuantity::position) return wide;
  auto over = identifier.options.Get<PositionMapOptions>();
  over.kernels = static_cast<int>(centres.size());
  return wide.With(over);
}

bool Structure::CanWarm() const { return identifier.IsCalled("energy-ml"); }

bool Structure::CanEstimateLag() const {
  return identifier.options.Find<LagOption>() &&
         identifier.options.OrDefault<WarmMapOptions>().position == WarmMap::none;
}

Structure Structure::PointEstimate() const {
  const auto* given = identifier.options.Find<MapOptions>();
  if (!given) return *this;
  MapOptions made = *given;
  made.bands = MapBands::none;
  return With(made);
}

bool Structure::CanHaveFields() const {
  return identifier.options.Find<FieldOption>() &&
         identifier.options.OrDefault<WarmMapOptions>().position == WarmMap::none;
}

bool Structure::CanEstimateDelay() const {
  return identifier.options.Find<DelayOption>() &&
         identifier.options.OrDefault<WarmMapOptions>().position == WarmMap::none;
}

Structure Structure::Quick() const {
  Structure sketch = PointEstimate();
  // rows of means do not show a delay
  if (CanEstimateDelay()) sketch = sketch.With(DelayOption{PartFit::none});
  if (!strength) return sketch;
  auto made = sketch.identifier.options.Get<MapOptions>();
  made.strength = *strength;
  return sketch.With(made);
}

Options Structure::OptionsWith(const Options& input) const {
  Options with = identifier.options;
  if (with.Find<InitialEnergyOptions>()) with = with.With(input.Get<InitialEnergyOptions>());
  if (input.OrDefault<MotionOption>().inertia == PartFit::none) with = WithoutInertia(with);
  return with;
}

Fit Structure::Fitted(const IdentifierInput& input) const {
  return identifier.fit(input.With(OptionsWith(input.options)));
}

std::optional<Eigen::VectorXd> Structure::UnseenOn(const IdentifierInput& input,
                                                   const std::vector<Eigen::Index>& bounds) const {
  return UnseenResiduals(identifier, input.With(Quick().OptionsWith(input.options)), bounds);
}

std::span<const Word<GravityToTry>> WordsOf(GravityToTry) {
  static const std::array words{Word<GravityToTry>{"chosen", {}},
                                Word<GravityToTry>{"none", {FittedGravity::none}},
                                Word<GravityToTry>{"sincos", {FittedGravity::sincos}},
                                Word<GravityToTry>{"paired", {FittedGravity::paired}}};
  return words;
}

std::vector<FittedGravity> GravityKinds(const IdentifierInput& input) {
  const auto& asked = input.options.Get<AutoOptions>().gravity.kind;
  if (asked) return {*asked};
  // a place that never changes shows nothing of gravity
  const Eigen::VectorXd& position = input.measurements.position;
  if (input.measurements.position_integrated || !position.allFinite() ||
      position.maxCoeff() == position.minCoeff())
    return {FittedGravity::none};
  if (input.measurements.joint == JointKind::linear)
    return {FittedGravity::none, FittedGravity::paired};
  return {FittedGravity::none, FittedGravity::sincos, FittedGravity::paired};
}

std::vector<Structure> ColdStructures(FittedGravity gravity) {
  return LinearStructures(FindIdentifier("nominal-ls"), gravity,
                          {ViscousCoulomb::name, Coulomb::name, Asymmetric::name});
}

std::vector<Structure> WarmStructures(FittedGravity gravity) {
  return LinearStructures(FindIdentifier("energy-ml"), gravity,
                          {Coulomb::name, ViscousCoulomb::name, Asymmetric::name});
}

Structure StribeckStructure(PartFit warming, FittedGravity gravity) {
  return Structure{FindIdentifier("stribeck"), "warming"}
      .With(StribeckOptions{.warming = warming})
      .With(GravityOption{gravity});
}

Structure TwoLevelStribeckStructure(PartFit warming, FittedGravity gravity) {
  return StribeckStructure(warming, gravity)
      .With(StribeckOptions{{&FindFallingLaw(AsymmetricStribeck::name)}, warming});
}

std::vector<Structure> MapStructures(const IdentifierInput& input, FittedGravity gravity,
                                     const ChosenKernels& kernels) {
  // what looks like gravity with a law that is too simple may be a map, unless gravity was asked for
  std::vector<FittedGravity> kinds{gravity};
  const bool is_asked = input.options.Get<AutoOptions>().gravity.kind.has_value();
  if (!is_asked && gravity != FittedGravity::none) {
    kinds.insert(kinds.begin(), FittedGravity::none);
  }

  std::vector<Structure> structures;
  const bool knows_motor = KnowsMotorAngle(input.measurements);
  // with the kernels and the strength that were chosen for the log, if any
  const auto add = [&](const Structure& one, const std::optional<ChosenMap>& chosen,
                       FittedGravity kind) {
    Structure& added = structures.emplace_back(one.With(GravityOption{kind}));
    if (!chosen) return;
    added.strength = chosen->strength;
    added = added.WithShapeOf(chosen->map);
  };
  const Structure warm{FindIdentifier("energy-ml")};
  for (const FittedGravity kind : kinds) {
    if (!input.measurements.position_integrated) {
      add(Structure{FindIdentifier("position-ridge")}, kernels.position, kind);
      add(warm.With(WarmMapOptions{{}, WarmMap::map}), kernels.position, kind);
    }
    // ripple of the motor, where its angle is known
    if (!knows_motor) continue;
    add(Structure{FindIdentifier("motor-ridge")}, kernels.motor, kind);
    add(warm.With(WarmMapOptions{{}, WarmMap::motor}), kernels.motor, kind);
  }
  return structures;
}

std::optional<double> LagOf(const Structure& structure, const TorqueModel& without,
                            const ThermalStart& start, const IdentifierInput& input) {
  const LogSamples& m = input.measurements;
  if (m.acceleration || !structure.CanEstimateLag()) return std::nullopt;

  // whether the residual of the model shows a lag at all
  const TorquePrediction predicted = PredictTorque(without, m, input.selection, start);
  const auto runs = std::make_shared<const KeptRuns>(FindRuns(m, predicted.covered));
  const Eigen::VectorXd torque = Kept(predicted.torque, predicted.covered);
  const Eigen::VectorXd residual = Kept(m.torque, predicted.covered) - torque;
  if (!ShowsLag(runs, torque, residual)) return std::nullopt;

  // then how long it is, by the structure that estimates it
  const Fit behind = structure.With(LagOption{PartFit::estimated}).Fitted(input);
  if (behind.refusal || !behind.model.lag) return std::nullopt;
  return behind.model.lag;
}

std::optional<LateTorque> FindLateTorque(const IdentifierInput& input) {
  if (input.view != View::moving) return std::nullopt;
  // without heat, which changes little within a delay; with gravity, unless the motion does not determine it
  const LogSamples& m = input.measurements;
  const bool may_swing =
      m.joint == JointKind::rotary && !m.position_integrated && m.position.allFinite();
  Structure richest =
      ColdStructures(may_swing ? FittedGravity::sincos : FittedGravity::none).back();
  Fit fit = richest.Fitted(input);
  if (fit.refusal) {
    richest = ColdStructures(FittedGravity::none).front();
    fit = richest.Fitted(input);
  }
  if (!IsLate(fit)) return std::nullopt;

  // the law compared with that of a fit without a delay
  const Fit in_time = richest.With(DelayOption{PartFit::none}).Fitted(input);
  const Eigen::MatrixXd columns =
      LawColumns(*FindLaw(fit.model.friction.law), Kept(m.velocity, fit.rows.used));
  const auto along = [&](const Fit& one) -> Eigen::VectorXd {
    const std::vector<double> values = LawValues(one.model.friction);
    return columns * Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values));
  };
  const Eigen::VectorXd force = along(fit);
  if (in_time.refusal) return LateTorque{*fit.model.delay, 1};
  return LateTorque{*fit.model.delay, (along(in_time) - force).norm() / force.norm()};
}

Selection Settled(const LogSamples& m, Selection selection, double lag) {
  const KeptRuns all = FindRuns(m, selection);
  for (const SampleRange& run : all.runs) {
    const double begin = all.time[run.first];
    const double wait = std::min(kSettledAfter * lag, 0.5 * (all.time[run.end() - 1] - begin));
    for (Eigen::Index i = run.first; i < run.end() && all.time[i] < begin + wait; ++i) {
      selection.keep[all.samples[static_cast<std::size_t>(i)]] = false;
    }
  }
  return selection;
}

}  // namespace warmjoint
