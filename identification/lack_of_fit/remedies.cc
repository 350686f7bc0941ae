#include "identification/lack_of_fit/remedies.h"

#include <warmjoint/friction.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "identification/fit/fit_data.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/lack_of_fit/gears.h"
#include "identification/lagged/lagged_fit.h"
#include "identification/linear/linear_laws.h"
#include "identification/preparation/check.h"
#include "identification/sentences/remedies.h"
#include "identification/warming/initial_energy.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/robust_noise.h"
#include "models/friction/laws.h"
#include "models/friction/parameter_rows.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

/// The next larger number with one digit that is not 0.
double RoundedUp(double value) {
  if (!(value > 0) || !std::isfinite(value)) return 0;
  const double unit = std::pow(10, std::floor(std::log10(value)));
  return unit * std::ceil(value / unit - 1e-9);
}

constexpr double kSettledAfter = 3;       // time constants; why 3: 5 % are left
constexpr size_t kMostKernels = 128;      // of a map over position; why: most that the options take
constexpr size_t kMostSpeedKernels = 64;  // for each direction; why: most that the options take
constexpr size_t kKernelsAPeriod = 3;     // why: a wave has two coefficients, and kernels overlap
constexpr double kOfAMotor =
    20;  // waves a turn; why: bearings and cams make fewer, gears of 10 and more as many

/// What a model holds already, whoever fitted it: the advice for `auto` is not to try what it chose.
bool HasMap(const Advice& advice, MapQuantity quantity) {
  return std::ranges::any_of(advice.fit.model.friction.maps, [=](const FrictionMap& map) {
    return FindAxis(map, quantity) != nullptr;
  });
}
bool HasWarming(const Advice& advice) { return advice.fit.RowOf(Role::gain).has_value(); }

/// To try a command, with the gravity and the lag of the torque that the fit has, where that identifier can estimate them.
Remedy Try(const Advice& advice, IdentifyCommand command, std::string words = "") {
  const Options& options = FindIdentifier(command.identifier).options;
  if (advice.fit.model.gravity && options.Has("gravity")) {
    const bool sincos = advice.fit.model.gravity->kind == GravityKind::sincos;
    command = command.With("gravity", sincos ? "sincos" : "paired");
  }
  // a lag with a law without map over position
  if (advice.fit.model.lag && options.Has("torque_lag") && !command.Sets("position")) {
    command = command.With("torque_lag", "estimated");
  }
  return {std::move(words), std::move(command)};
}

/// Law and maps over position, or over the motor's angle, with the warming that the fit has.
IdentifyCommand WithMap(const Advice& advice, MapQuantity quantity) {
  const bool position = quantity == MapQuantity::position;
  if (HasWarming(advice)) {
    return IdentifyCommand{"energy-ml"}.With("position", position ? "map" : "motor");
  }
  return {position ? "position-ridge" : "motor-ridge"};
}

/// From the first sample to the last, s.
double DurationOf(const Advice& advice) {
  const Eigen::VectorXd& time = advice.input.measurements.time;
  return time[time.size() - 1] - time[0];
}

/// Whether the law has a curve over speed.
bool HasCurve(const Advice& advice) {
  return advice.fit.model.friction.parameters.contains(std::string(kStribeckVelocityRow.name));
}

/// The warming that a fit holds, as an option's word.
const char* WarmingOf(const Advice& advice) { return HasWarming(advice) ? "estimated" : "none"; }

/// Kernels of the first axis over a quantity; 0 where there is none.
size_t KernelsOver(const Advice& advice, MapQuantity quantity) {
  for (const FrictionMap& map : advice.fit.model.friction.maps) {
    if (const MapAxis* axis = FindAxis(map, quantity)) return axis->kernels.size();
  }
  return 0;
}

/// A map with twice as many kernels, up to the number that the options take.
Remedy Finer(const Advice& advice, MapQuantity quantity, const char* option) {
  const size_t kernels = 2 * KernelsOver(advice, quantity);
  if (kernels > kMostKernels) {
    return {kNoFinerMap};
  }

  return Try(advice, WithMap(advice, quantity).With(option, std::to_string(kernels)));
}

/// The gears of a motor whose ripple a test over the position found, by what the fit leaves; none of no motor.
std::vector<int> GearsOfRipple(const Advice& advice) {
  const LogSamples& m = advice.input.measurements;
  const double strongest = 2 * std::numbers::pi / advice.finding.period;
  if (m.joint != JointKind::rotary || KnowsMotorAngle(m)) return {};
  if (!(strongest >= kOfAMotor) || !std::isfinite(strongest)) return {};
  const Selection& used = advice.fit.rows.used;
  const Eigen::VectorXd residual = advice.fit.rows.residual();
  if (used.keep.size() != m.size() || used.count() != residual.size()) return {};
  return GearsOf(Kept(m.position, used), Kept(m.velocity, used), residual, MedianStep(m.time));
}

}  // namespace

Remedy WithoutWhatWasDone(const Advice& advice, Remedy remedy) {
  const std::optional<IdentifyCommand>& command = remedy.command;
  if (!command || command->identifier != advice.fit.identifier) return remedy;
  const std::vector<OptionInfo> options = advice.input.options.List();
  const bool done = std::ranges::all_of(command->settings, [&](const auto& setting) {
    const auto option = std::ranges::find(options, setting.first, &OptionInfo::name);
    return option != options.end() && option->value == setting.second;
  });
  if (!done) return remedy;
  return {kModelHasThat};
}

std::string RemedyForWarmStart(const Identifier& identifier) {
  if (identifier.options.Find<InitialEnergyOptions>()) return kEstimateStart;
  return kRecordFromCold;
}

Remedy RemedyForWarming(const Advice& advice) {
  // no warming yet: one in addition to whatever else the fit holds
  if (!HasWarming(advice)) {
    if (const double duration = DurationOf(advice); duration < kShortestWarming) {
      return {RemedyForShortLog(duration, kShortestWarming)};
    }
    const IdentifyCommand warm{"energy-ml"};
    if (HasMap(advice, MapQuantity::motor_position)) {
      return Try(advice, warm.With("position", "motor"));
    }
    if (HasMap(advice, MapQuantity::position)) return Try(advice, warm.With("position", "map"));
    if (HasCurve(advice))
      return Try(advice, CurveCommand(advice.fit.model.friction.law, "estimated"));
    return Try(advice, warm);
  }

  // a warming that does not explain it: the start may have been warm
  if (TakesColdStart(advice.input.options)) {
    return {kWarmStartOrOneStage};
  }
  return {kOneStageTooFew};
}

Remedy RemedyForStart(const Advice& advice) {
  return {AskForWarmStart(RemedyForWarmStart(advice.identifier))};
}

Remedy RemedyForSpeed(const Advice& advice) {
  if (HasCurve(advice)) {
    return {kLawHasCurve};
  }
  if (HasMap(advice, MapQuantity::velocity) && KernelsOver(advice, MapQuantity::velocity) > 2) {
    return {kMapHasSpeed};
  }

  // a map over position gets kernels over speed as well, a law gets a curve
  if (HasMap(advice, MapQuantity::position)) {
    return Try(advice, WithMap(advice, MapQuantity::position).With("basis", "velocity"));
  }
  return Try(advice, CurveCommand(advice.fit.model.friction.law, WarmingOf(advice)));
}

Remedy RemedyForWarmingSlope(const Advice& advice) {
  if (HasMap(advice, MapQuantity::energy)) {
    return {kRecordMoreWarmUps};
  }
  // with a map over position, the map over energy has to follow the slope too
  return Try(advice, {advice.fit.model.friction.maps.empty() ? "lpv-energy" : "energy-map"});
}

/// What to try where a law with a curve misses something that turns with the direction.
Remedy RemedyForDirectionOfACurve(const Advice& advice) {
  const Friction& friction = advice.fit.model.friction;
  if (HasLevelForEachDirection(friction.law)) {
    // heat is common to both
    return {HasWarming(advice) ? kLawHasBothLevels : RemedyForBothLevels()};
  }
  if (friction.law != LuGre::name) {
    return Try(advice, CurveCommand(AsymmetricStribeck::name, WarmingOf(advice)));
  }

  // a law with a bristle keeps it, with the damping that it has or none
  const bool damped = friction.parameters.at(std::string(kBristleDampingRow.name)) != 0;
  const IdentifyCommand command = IdentifyCommand{"lugre"}.With("law", AsymmetricLuGre::name);
  return Try(advice, damped ? command : command.With("damping", "none"));
}

Remedy RemedyForGravity(const Advice& advice) {
  const IdentifyCommand command{advice.identifier.options.Has("gravity") ? advice.fit.identifier
                                : HasWarming(advice)                     ? "energy-ml"
                                                                         : "nominal-ls"};
  return {kActsAsWeight, command.With("gravity", "sincos")};
}

Remedy RemedyForRecording(const Advice&) { return {kIdentifyRecordings}; }

Remedy RemedyForDirection(const Advice& advice) {
  if (HasCurve(advice)) return RemedyForDirectionOfACurve(advice);

  // first a law with a level for each direction, where the identifier has one
  const bool can = advice.identifier.options.Has("law");
  const bool mapped = HasMap(advice, MapQuantity::position);
  if (can && advice.fit.model.friction.law != "asymmetric" && !advice.fit.model.gravity) {
    const IdentifyCommand command =
        IdentifyCommand{advice.identifier.name}.With("law", "asymmetric");
    const bool warm_map = mapped && HasWarming(advice);
    return Try(advice, warm_map ? command.With("position", "map") : command);
  }

  // then a force in one direction of whatever kind, which paired gravity takes up
  if (!mapped && !advice.fit.model.gravity) {
    const IdentifyCommand command{HasWarming(advice) ? "energy-ml" : "nominal-ls"};
    return {kPushesInOneDirection, command.With("gravity", "paired")};
  }
  if (HasMap(advice, MapQuantity::velocity)) {
    return {kMapHasDirections};
  }

  // else the slopes differ, which kernels over speed can follow
  return Try(advice, WithMap(advice, MapQuantity::position).With("basis", "velocity"),
             kDiffersInSlope);
}

Remedy RemedyForLoad(const Advice& advice) {
  if (HasMap(advice, MapQuantity::load)) {
    return {kMoreThanLoad};
  }
  const bool may_grow = advice.fit.model.friction.maps.empty() && !advice.fit.RowOf(Role::load) &&
                        IsLinear(*FindLaw(advice.fit.model.friction.law));
  // a load that the fit took from its gravity is not a column of the log
  const bool is_logged = advice.input.log.raw().measurements.load.has_value();
  if (!may_grow && !is_logged) return Try(advice, WithMap(advice, MapQuantity::position));
  if (!may_grow) return Try(advice, {"load-map"});
  const std::string_view like = advice.fit.RowOf(Role::gain) ? "energy-ml" : "nominal-ls";
  return Try(advice, LinearCommand(like, advice.fit.model.friction.law).With("load", "estimated"));
}

Remedy RemedyForTemperature(const Advice&) { return {kSteadyTemperature}; }

Remedy RemedyForStep(const Advice&) { return {kIdentifyPartsOfStep}; }

Remedy RemedyForMemory(const Advice& advice) {
  const double settled = kSettledAfter * advice.finding.period;
  return {RemedyByLongHolds(3 * settled, settled)};
}

Remedy RemedyForHolds(const Advice&) { return {kChangesWithHolds}; }

Remedy RemedyForPeriod(const Advice& advice) {
  const std::vector<std::string>& others = advice.input.measurements.other_joints;
  if (others.empty()) return {kOwnRhythm};
  return {RemedyForOtherJoints(ExcerptOfList(others))};
}

Remedy RemedyForLag(const Advice& advice) {
  const Law& law = *FindLaw(advice.fit.model.friction.law);
  // a lag is estimated with linear laws only, without maps and inertia
  const bool can =
      IsLinear(law) && advice.fit.model.friction.maps.empty() && !advice.fit.model.inertia;
  const bool asked = AsksForLag(advice.input.options);
  // holds are free of the lag some time constants after they began
  const double trim = RoundedUp(kSettledAfter * advice.finding.lag);
  const std::string cut =
      advice.fit.model.inertia || !(trim > 0) ? kShiftTorque : RemedyByTrim(trim);
  if (!can || asked || advice.fit.model.lag) return {AskForLateTorque(cut)};
  IdentifyCommand command{HasWarming(advice) ? "energy-ml" : "nominal-ls"};
  if (law.name != "viscous_coulomb") command = command.With("law", law.name);
  return Try(advice, command.With("torque_lag", "estimated"), AskForLateTorqueOr(cut));
}

Remedy RemedyForFading(const Advice& advice) {
  if (HasMap(advice, MapQuantity::energy)) {
    return {kRecordMoreWarmUps};
  }
  return Try(advice, {"energy-map"});
}

Remedy RemedyForPosition(const Advice& advice) {
  const bool alike = advice.finding.alike > 0.8;
  const RippleActs acts = alike ? RippleActs::alike : RippleActs::otherwise;
  const Eigen::VectorXd& position = advice.input.measurements.position;
  const double periods = (position.maxCoeff() - position.minCoeff()) / advice.finding.period;
  constexpr size_t most = kMostKernels / kKernelsAPeriod;

  // ripple of a motor whose angle the log does not have
  if (const std::vector<int> gears = GearsOfRipple(advice); !gears.empty()) {
    const std::string likeliest = std::to_string(gears.front());
    return Try(advice, WithMap(advice, MapQuantity::motor_position).With("gear", likeliest),
               ExplainByMotor(acts, gears));
  }

  // ripple that returns more often than a map has kernels for
  if (periods > most) {
    return {RemedyForFineRipple(
        acts, {.periods = periods, .most = most, .longest = most * advice.finding.period},
        advice.input.measurements.joint)};
  }

  // a finer map, or the first one
  if (HasMap(advice, MapQuantity::position)) {
    return Finer(advice, MapQuantity::position, "kernels");
  }
  const IdentifyCommand map = WithMap(advice, MapQuantity::position);
  if (!alike) return Try(advice, map);
  return Try(advice, map.With("basis", "position"), ExplainByLoad(acts));
}

Remedy RemedyForMotorAngle(const Advice& advice) {
  if (HasMap(advice, MapQuantity::motor_position)) {
    return Finer(advice, MapQuantity::motor_position, "motor_kernels");
  }
  return Try(advice, WithMap(advice, MapQuantity::motor_position));
}

Remedy RemedyForAngleBySpeed(const Advice& advice) {
  const bool motor = HasMap(advice, MapQuantity::motor_position);
  IdentifyCommand command =
      WithMap(advice, motor ? MapQuantity::motor_position : MapQuantity::position);
  if (!motor) command = command.With("basis", "velocity");
  // a map that distinguishes directions only gets kernels over speed; one that has such kernels gets twice as many for each direction
  const size_t kernels = KernelsOver(advice, MapQuantity::velocity);
  if (kernels <= 2) return Try(advice, command);
  if (kernels > kMostSpeedKernels) {
    return {kNoFinerMapOverSpeed};
  }
  return Try(advice, command.With("velocity_kernels", std::to_string(kernels)));
}

}  // namespace warmjoint
