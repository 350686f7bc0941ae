#include "identification/robot/explain_robot.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "identification/robot/robot_joint.h"

namespace warmjoint {

std::string SummaryOfJoint(const JointFit& fit, const JointColumns& c) {
  return fmt::format(
      "fitted {} samples with the description as prior{}{}, residual {:.3g} {}",
      c.samples.keep.count(), fit.at.law.size == 4 ? ", friction that rises at low speed" : "",
      fit.at.heat ? ", warming" : "", std::sqrt(fit.solved.noise.variance), c.torque_unit);
}

std::string ExplainDidNotMove(const std::string& joint, double travel, JointKind kind) {
  return fmt::format("did not move: {} travels {:.3g} {}; log a motion of it", joint, travel,
                     kPositionUnit.For(kind));
}

std::string ExplainLittleMotion(const std::string& joint, long samples, long needed) {
  return fmt::format(
      "{} moves clearly in {} samples, and {} are needed away from rests and reversals; log longer "
      "strokes, or raise --cutoff",
      joint, samples, needed);
}

std::string ExplainOneDirection(const std::string& joint) {
  return fmt::format(
      "{} moves in one direction alone, where friction and gravity act alike; log both", joint);
}

std::string ExplainBeyond(const std::vector<std::string>& rows) {
  return fmt::format(
      "{} below 0 with the whole interval: friction would drive the joint; check the sign of its "
      "torque (--scale), the order of the joints and the description",
      fmt::join(rows, " and "));
}

std::string ExplainUntold(double level, double reach, const std::string& unit) {
  return fmt::format(
      "Coulomb friction is unknown: {:.3g} +- {:.3g} {}; log slower and faster motion in both "
      "directions",
      level, reach, unit);
}

std::string ExplainResidual(double left, double friction, const std::string& unit) {
  return fmt::format(
      "the residual of {:.3g} {} is more than half of the friction, {:.3g}: the description, the "
      "joint's torque or its sign are not those of the log, or its motor ripples (--gear N fits "
      "that)",
      left, unit, friction);
}

std::string ExplainWorseHeldOut(double with, double without, const std::string& unit) {
  return fmt::format(
      "on held-out samples the residual is {:.3g} {} with friction and {:.3g} without: the log "
      "does "
      "not repeat what was fitted; log more of the same kind of motion",
      with, unit, without);
}

std::string ExplainTurnedTorque(const std::string& joint) {
  return fmt::format(
      "the torque of {} drives its motion where friction would brake: its sign is taken to be "
      "turned "
      "(--scale {}.torque=-1)",
      joint, joint);
}

std::string ExplainTurnedSign(const std::string& joint) {
  return fmt::format(
      "torque and description of {} have opposite signs, though its friction brakes: its axis is "
      "turned against that of the description (--scale {}.torque=-1,{}.position=-1)",
      joint, joint, joint);
}

std::string ExplainWrongDescription(const std::string& joint, double times) {
  return fmt::format(
      "{}: the torque is that of a description {:.1f} times as wrong as its prior allows, or of "
      "something that neither description nor "
      "friction has. With a load, friction is as sure as it says; with a ripple over the angle, it "
      "is not. --tool unknown fits "
      "a load, --gear a motor's ripple, --inertials given:SHARE says how wrong the description may "
      "be",
      joint, times);
}

std::string ExplainUnknownGain(const std::string& joint) {
  return fmt::format(
      "the gain of its current is unknown, so friction is in A; give --torque-constant "
      "{}=N.m/A",
      joint);
}

}  // namespace warmjoint
