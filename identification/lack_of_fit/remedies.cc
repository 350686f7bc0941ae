#include "identification/lack_of_fit/remedies.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "identification/lack_of_fit/words.h"

namespace warmjoint::inline identification {
namespace {

/// "try NAME" for an identifier other than the one that was used; else `otherwise`.
std::string Try(std::string_view name, const Advice& advice, const std::string& otherwise) {
  return advice.fit.identifier == name ? otherwise : fmt::format("try {}", name);
}

/// Whether E(0) can be estimated: the fits with maps cannot.
bool TakesStart(const Identifier& identifier, const IdentifierInput& input) {
  return identifier.Has("initial_energy") && input.options.Text("position") == "none";
}

/// Whether gravity may be what acts alike in both directions: it turns once with the joint, so that
/// along the travel it is one slow wave.
bool MayBeGravity(const Advice& advice) {
  const Eigen::VectorXd& position = advice.input.measurements.position;
  const double travel = position.maxCoeff() - position.minCoeff();
  const bool slow = advice.finding.period > std::min(std::numbers::pi, 0.9 * travel);
  return advice.input.measurements.joint == JointKind::rotary && slow &&
         advice.identifier.Has("gravity") && !advice.fit.gravity;
}

}  // namespace

std::string AgainstWarmStart(const Identifier& identifier, const IdentifierInput& input) {
  if (TakesStart(identifier, input)) return "try --start estimated";
  return "record it from cold, or learn E(0) by energy-ml with --start estimated";
}

std::string AgainstWarming(const Advice& advice) {
  if (!advice.fit.RowOf(Role::heat)) {
    return Try("energy-ml", advice, "record it at a steady temperature");
  }
  if (TakesStart(advice.identifier, advice.input) &&
      advice.input.options.Text("initial_energy") == "zero") {
    return "if the joint was warm at the start, try --start estimated; else one time constant is "
           "too few, or the surroundings change their temperature";
  }
  return "one time constant is too few, or the surroundings change their temperature; record it at "
         "a steady ambient temperature";
}

std::string AgainstStart(const Advice& advice) {
  return "was the joint warm at the start? " + AgainstWarmStart(advice.identifier, advice.input);
}

std::string AgainstSpeed(const Advice& advice) {
  return Try("stribeck", advice, "the law lacks a curve over speed (Stribeck)");
}

std::string AgainstWarmingSlope(const Advice& advice) {
  // beside a map over position, the map over energy has to follow the slope too
  const bool mapped = !advice.fit.friction.maps.empty();
  return Try(mapped ? "energy-map" : "lpv-energy", advice, "more kernels over energy would fit it");
}

std::string AgainstDirection(const Advice& advice) {
  const bool can = advice.identifier.Has("law") && advice.input.options.Text("law") != "asymmetric";
  if (can) return "try --set law=asymmetric";
  const std::string slope = "friction differs in slope between the directions";
  const std::string next = Try("position-ridge", advice, "");
  return next.empty() ? slope : fmt::format("{}: {} with --set basis=velocity", slope, next);
}

std::string AgainstLoad(const Advice& advice) {
  return Try("load-map", advice, "more kernels over load would fit it");
}

std::string AgainstTemperature(const Advice&) { return "record it at a steady temperature"; }

std::string AgainstStep(const Advice&) {
  return "something changed at that moment (load, lubrication, sensor): identify the parts before "
         "and after it as recordings of their own";
}

std::string AgainstHolds(const Advice&) {
  return "something changes with the holds (load, settling of the drive, backlash): leave out the "
         "beginning of each hold, or log what changes as load";
}

std::string AgainstPeriod(const Advice&) {
  return "something acts on the joint in a rhythm of its own: log it as load, or record without it";
}

std::string AgainstLag(const Advice&) {
  return "is the torque filtered or late? shift it against the velocity, or log both alike";
}

std::string AgainstFading(const Advice& advice) {
  return Try("energy-map", advice, "more kernels over energy would fit it");
}

std::string AgainstPosition(const Advice& advice) {
  if (advice.finding.alike <= 0.8) {
    return Try("position-ridge", advice, "a map over position would fit it");
  }
  const std::string alike = "it acts alike in both directions, as ";
  if (MayBeGravity(advice)) return alike + "gravity does: try --gravity sincos";
  const std::string next = Try("position-ridge", advice, "");
  return alike + "a load does that depends on position" +
         (next.empty() ? next : ": " + next + " with --set basis=position");
}

std::string AgainstMotorAngle(const Advice& advice) {
  return Try("motor-ridge", advice, "a map over the motor angle would fit it");
}

}  // namespace warmjoint::inline identification
