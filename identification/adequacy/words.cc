#include "identification/adequacy/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "models/friction/law.h"

namespace warmjoint::inline identification {
namespace {

/// "try NAME" for an identifier other than the one that was used; else `otherwise`.
std::string Try(std::string_view name, const Fit& fit, const std::string& otherwise) {
  return fit.identifier == name ? otherwise : fmt::format("try {}", name);
}

/// Whether E(0) can be estimated: the fits with maps cannot.
bool TakesStart(const Identifier& identifier, const IdentifierInput& input) {
  return identifier.Has("initial_energy") && input.options.Text("position") == "none";
}

std::string AgainstHeat(const Identifier& identifier, const IdentifierInput& input,
                        const Fit& fit) {
  if (!fit.RowOf(Role::heat)) {
    return Try("energy-ml", fit, "record it at a steady temperature");
  }
  if (TakesStart(identifier, input) && input.options.Text("initial_energy") == "zero") {
    return "if the joint was warm at the start, try --set initial_energy=estimated; else one time "
           "constant is too few, or the surroundings change their temperature";
  }
  return "one time constant is too few, or the surroundings change their temperature; record it at "
         "a steady ambient temperature";
}

std::string AgainstSpeed(const Fit& fit) {
  return Try("stribeck", fit, "the law lacks a curve over speed (Stribeck)");
}

/// Beside a map over position, the map over energy has to follow the slope too.
std::string AgainstWarmingSlope(const Fit& fit) {
  const bool mapped = !fit.friction.maps.empty();
  return Try(mapped ? "energy-map" : "lpv-energy", fit, "more kernels over energy would follow it");
}

std::string AgainstDirection(const Identifier& identifier, const IdentifierInput& input,
                             const Fit& fit) {
  const bool can = identifier.Has("law") && input.options.Text("law") != "asymmetric";
  if (can) return "try --set law=asymmetric";
  const std::string slope = "friction differs in slope between the directions";
  const std::string next = Try("position-ridge", fit, "");
  return next.empty() ? slope : fmt::format("{}: {} with --set basis=velocity", slope, next);
}

std::string AgainstPosition(const Structure& structure, const Identifier& identifier,
                            const IdentifierInput& input, const Fit& fit) {
  if (structure.alike > 0.8) {
    // gravity turns once with the joint: along the travel it is one slow wave
    const Eigen::VectorXd& position = input.measurements.position;
    const double travel = position.maxCoeff() - position.minCoeff();
    const bool slow = structure.period > std::min(std::numbers::pi, 0.9 * travel);
    const bool gravity = input.measurements.joint == JointKind::rotary && slow &&
                         identifier.Has("gravity") && !fit.gravity;
    const std::string alike = "it acts alike in both directions, as ";
    if (gravity) return alike + "gravity does: try --gravity sincos";
    const std::string next = Try("position-ridge", fit, "");
    return alike + "a load does that depends on position" +
           (next.empty() ? next : ": " + next + " with --set basis=position");
  }
  return Try("position-ridge", fit, "a map over position would follow it");
}

}  // namespace

std::string DescribeStructure(const Adequacy& adequacy, const Structure& structure,
                              const Measurements& measurements) {
  const auto name = [&]() -> std::string {
    const std::string_view unit = kPositionUnit.For(measurements.joint);
    switch (structure.on) {
      case Dependence::time:
        return "time";
      case Dependence::energy:
        return "energy (warming)";
      case Dependence::initial_energy:
        return "the energy at the start";
      case Dependence::speed:
        return "speed";
      case Dependence::speed_by_energy:
        return "speed x energy (the slope warms)";
      case Dependence::direction:
        return "direction";
      case Dependence::lag:
        return fmt::format(
            "the time since the last change of speed (the torque lags by some {:.1g} s)",
            structure.period);
      case Dependence::load:
        return "load";
      case Dependence::temperature:
        return "temperature";
      case Dependence::position:
        return fmt::format("position (period {:.3g} {})", structure.period, unit);
      case Dependence::position_by_energy:
        return "position x energy (the map fades or grows as the joint warms)";
      case Dependence::motor_angle:
        break;
    }
    return fmt::format("motor angle (period {:.3g} rad)", structure.period);
  };
  const double rms = adequacy.Rms(structure);
  const double share = std::min(structure.explained / adequacy.squares, 1.0);
  return fmt::format(
      "{}: {:.3g} {} rms, {:.2g} % of the friction, {:.0f} % of the residual's variance", name(),
      rms, measurements.torque_unit, 100 * rms / adequacy.friction, 100 * share);
}

std::string AgainstWarmStart(const Identifier& identifier, const IdentifierInput& input) {
  if (TakesStart(identifier, input)) return "try --set initial_energy=estimated";
  return "record it from cold, or learn E(0) by energy-ml with --set initial_energy=estimated";
}

std::string Remedy(const Structure& structure, const Identifier& identifier,
                   const IdentifierInput& input, const Fit& fit) {
  switch (structure.on) {
    case Dependence::time:
    case Dependence::energy:
      return AgainstHeat(identifier, input, fit);
    case Dependence::initial_energy:
      return "was the joint warm at the start? " + AgainstWarmStart(identifier, input);
    case Dependence::speed:
      return AgainstSpeed(fit);
    case Dependence::speed_by_energy:
      return AgainstWarmingSlope(fit);
    case Dependence::direction:
      return AgainstDirection(identifier, input, fit);
    case Dependence::lag:
      return "is the torque filtered or late? shift it against the velocity, or log both alike";
    case Dependence::load:
      return Try("load-map", fit, "more kernels over load would follow it");
    case Dependence::temperature:
      return "record it at a steady temperature";
    case Dependence::position:
      return AgainstPosition(structure, identifier, input, fit);
    case Dependence::position_by_energy:
      return Try("energy-map", fit, "more kernels over energy would follow it");
    case Dependence::motor_angle:
      break;
  }
  return Try("motor-ridge", fit, "a map over the motor angle would follow it");
}

}  // namespace warmjoint::inline identification
