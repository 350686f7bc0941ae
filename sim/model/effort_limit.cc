#include "sim/model/effort_limit.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "sim/model/joint_pattern.h"
#include "sim/model/spec_elements.h"

namespace warmjoint::inline sim {
namespace {

/// Gives an actuator the range of its joint, in the actuator's own force, cut to what it had.
void LimitForce(mjsActuator& motor, const double range[2]) {
  // a negative gear turns the range round
  const double gear = motor.gear[0];
  const double lower = std::min(range[0] / gear, range[1] / gear);
  const double upper = std::max(range[0] / gear, range[1] / gear);

  // a range that the actuator had already stays, where it is narrower
  const bool limited =
      motor.forcelimited == mjLIMITED_TRUE ||
      (motor.forcelimited == mjLIMITED_AUTO && motor.forcerange[0] < motor.forcerange[1]);
  motor.forcerange[0] = limited ? std::max(motor.forcerange[0], lower) : lower;
  motor.forcerange[1] = limited ? std::min(motor.forcerange[1], upper) : upper;
  motor.forcelimited = mjLIMITED_TRUE;
}

bool Drives(const mjsActuator& motor, const std::string& joint) {
  const bool by_joint = motor.trntype == mjTRN_JOINT || motor.trntype == mjTRN_JOINTINPARENT;
  return by_joint && motor.gear[0] != 0 && mjs_getString(motor.target) == joint;
}

/// Number of actuators that took the joint's limit.
int LimitMotors(mjSpec& spec, const std::string& joint, const double range[2]) {
  int motors = 0;
  for (mjsElement* element : SpecElements(spec, mjOBJ_ACTUATOR)) {
    mjsActuator* motor = mjs_asActuator(element);
    if (!Drives(*motor, joint)) continue;
    LimitForce(*motor, range);
    ++motors;
  }
  return motors;
}

bool Limited(const mjsJoint& joint) {
  if (joint.actfrclimited != mjLIMITED_AUTO) return joint.actfrclimited == mjLIMITED_TRUE;
  return joint.actfrcrange[0] < joint.actfrcrange[1];
}

void Note(const std::vector<std::string>& joints, const char* sentence,
          std::vector<std::string>& notices) {
  if (joints.empty()) return;
  notices.push_back(fmt::format("{}: {}", fmt::join(joints, ", "), sentence));
}

}  // namespace

std::vector<std::string> MoveEffortLimits(mjSpec& spec, const std::vector<std::string>& joints,
                                          const Place& place) {
  std::vector<std::string> moved, shared, dropped;
  // motors take the joint's limit over, so that it clips them and not friction
  for (const std::string& name : joints) {
    mjsJoint* joint = FindJoint(spec, name, place);
    if (!Limited(*joint)) continue;
    const int motors = LimitMotors(spec, name, joint->actfrcrange);
    if (motors == 0) {
      dropped.push_back(
          fmt::format("{} ({} to {})", name, joint->actfrcrange[0], joint->actfrcrange[1]));
    } else {
      (motors == 1 ? moved : shared).push_back(name);
    }
    joint->actfrclimited = mjLIMITED_FALSE;
  }
  std::vector<std::string> notices;
  Note(moved, "the joint's effort limit now limits its actuator alone; it would clip friction too",
       notices);
  Note(shared,
       "the joint's effort limit now limits each of its actuators by itself and no longer their "
       "sum; it would clip friction too",
       notices);
  Note(dropped,
       "the joint's effort limit was taken away, since it would clip friction and no actuator "
       "drives the joint; give this range to the actuator that you add, as its forcerange",
       notices);
  return notices;
}

}  // namespace warmjoint::inline sim
