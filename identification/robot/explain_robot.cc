#include "identification/robot/explain_robot.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "identification/robot/robot_joint.h"
#include "identification/uncertainty/tails.h"

namespace warmjoint {

std::string SummaryOfJoint(const JointFit& fit, const JointColumns& c) {
  return fmt::format(
      "fitted {} samples with the description as prior{}{}, residual {:.3g} {}",
      c.samples.keep.count(), fit.Slows() ? ", friction that rises at low speed" : "",
      fit.Has(Role::gain) ? ", warming" : "", std::sqrt(fit.solved.noise.variance), c.torque_unit);
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

std::string ExplainTurnedTorque(const std::string& joint) {
  return fmt::format(
      "the torque of {} drives its motion where friction would brake: its sign is taken to be "
      "turned "
      "(--scale {}.torque=-1)",
      joint, joint);
}

std::string ExplainDelayOfAll(double delay, double deviation) {
  const double reach = 1e3 * kNormal95 * deviation;
  return fmt::format(
      "the {} come {:.3g} +- {:.2g} ms after the {}, in all joints alike: positions are taken at "
      "that time, and intervals hold what is left open",
      delay > 0 ? "torques" : "positions", 1e3 * std::abs(delay), reach,
      delay > 0 ? "positions" : "torques");
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

std::string ExplainScaleOfAll(double gain) {
  return fmt::format(
      "the torques of all joints are {:.3g} times those of the description: they are of the "
      "motors' side of the gears, or in another unit; --scale torque={:.4g} makes them of the "
      "joints, --inertials given:1 says that the description is so wrong",
      gain, 1 / gain);
}

std::string ExplainScale(const std::string& joint, double gain) {
  return fmt::format(
      "the torque of {} is {:.3g} times that of the description: it is of the motor's side of a "
      "gear, or in another unit; --scale {}.torque={:.4g} makes it of the joint, --inertials "
      "given:1 says that the description is so wrong",
      joint, gain, joint, 1 / gain);
}

std::string ExplainDoubtfulGain(const std::string& joint, double gain) {
  return fmt::format(
      "the torque of {} is {:.3g} times that of the description, more than descriptions are wrong "
      "by: where its unit or constant is in doubt, so is its friction (--scale {}.torque={:.3g})",
      joint, gain, joint, 1 / gain);
}

std::string ExplainOffset(const std::string& joint, double value, double reach,
                          const std::string& unit) {
  return fmt::format(
      "the torque of {} has an offset of {:.3g} +- {:.2g} {}, since the friction of a gear differs "
      "less by direction: it is not friction, and the friction file is without it",
      joint, value, reach, unit);
}

std::string ExplainUnknownGain(const std::string& joint) {
  return fmt::format(
      "the gain of its current is unknown, so friction is in A; give --torque-constant "
      "{}=N.m/A",
      joint);
}

}  // namespace warmjoint
