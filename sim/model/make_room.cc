#include "sim/model/make_room.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "models/friction/joint_friction.h"
#include "sim/model/friction_actuator.h"
#include "sim/model/spec_elements.h"
#include "sim/plugin/plugin_instances.h"

namespace warmjoint {
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

/// Moves the effort limits (actuatorfrcrange, effort in URDF) of the named joints to the actuators
/// that drive them, cut to what these had: a joint's limit clips the sum of its actuators, and
/// would clip a friction that is one of them. A limit R of the joint is R / gear of an actuator.
/// Of a joint that no actuator drives by itself the limit is taken away, and nothing added.
/// Notes what was done, one sentence each.
void MoveEffortLimits(mjSpec& spec, const std::vector<std::string>& joints, const Place& place,
                      std::vector<std::string>& notices) {
  std::vector<std::string> moved, shared, dropped;
  // motors take the joint's limit over, so that it clips them and not friction
  for (const std::string& name : joints) {
    mjsJoint* joint = FindJoint(spec, name, place);
    if (!Limited(*joint)) continue;
    // what has no end limits nothing
    if (std::isinf(joint->actfrcrange[0]) && std::isinf(joint->actfrcrange[1])) {
      joint->actfrclimited = mjLIMITED_FALSE;
      continue;
    }
    const int motors = LimitMotors(spec, name, joint->actfrcrange);
    if (motors == 0) {
      dropped.push_back(
          fmt::format("{} ({} to {})", name, joint->actfrcrange[0], joint->actfrcrange[1]));
    } else {
      (motors == 1 ? moved : shared).push_back(name);
    }
    joint->actfrclimited = mjLIMITED_FALSE;
  }
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
}

/// Takes the damping of the actuators that drive a joint, which MuJoCo adds to the joint's; whether there was any.
bool ClearMotorDamping(mjSpec& spec, const std::string& joint) {
  bool any = false;
  for (mjsElement* element : SpecElements(spec, mjOBJ_ACTUATOR)) {
    mjsActuator* motor = mjs_asActuator(element);
    if (!Drives(*motor, joint)) continue;
    any = any || std::ranges::any_of(motor->damping, [](double one) { return one != 0; });
    std::ranges::fill(motor->damping, 0.0);
  }
  return any;
}

/// How much of a joint's motion goes into a tendon's length by itself is a millionth of it at least.
constexpr double kMoves = 1e-6;

/// Whether a joint's motion changes a tendon's length, in the reference pose or beside it.
bool Moves(const mjModel* m, int tendon, int joint) {
  const DataPtr d(mj_makeData(m));
  mjtNum& q = d->qpos[m->jnt_qposadr[joint]];
  const mjtNum start = q, step = 0.1;
  std::array<double, 3> lengths;
  for (int k = 0; k < 3; ++k) {
    q = start + (k - 1) * step;
    mj_kinematics(m, d.get());
    mj_comPos(m, d.get());
    mj_tendon(m, d.get());
    lengths[static_cast<size_t>(k)] = d->ten_length[tendon];
  }
  const auto [least, most] = std::ranges::minmax(lengths);
  return most - least > kMoves * step;
}

/// Whether a motor brings friction of its own: the LuGre of a dcmotor, whose Coulomb and static levels lie in
/// its bias.
bool HasOwnFriction(const mjModel* m, int actuator) {
  const mjtNum* bias = m->actuator_biasprm + actuator * mjNBIAS;
  return m->actuator_biastype[actuator] == mjBIAS_DCMOTOR && (bias[3] > 0 || bias[4] > 0);
}

/// By what a tendon resists motion as friction does.
std::vector<const char*> ResistanceOf(const mjModel& m, int tendon) {
  std::vector<const char*> found;
  if (m.tendon_frictionloss[tendon] > 0) found.push_back("frictionloss");
  if (m.tendon_damping[tendon] > 0) found.push_back("damping");
#if mjVERSION_HEADER >= 4000000
  if (m.tendon_springyield[tendon] > 0 && m.tendon_stiffness[tendon] > 0) {
    found.push_back("the spring with a yield");
  }
#endif
  return found;
}

}  // namespace

void Note(const std::vector<std::string>& names, const char* sentence,
          std::vector<std::string>& notices) {
  if (names.empty()) return;
  notices.push_back(fmt::format("{}: {}", fmt::join(names, ", "), sentence));
}

void MakeRoom(mjSpec& spec, const std::vector<FrictionForJoint>& frictions, FrictionForm form,
              const Place& place, std::vector<std::string>& notices) {
  // the joints' own damping and dry friction, and what their motors add
  std::vector<std::string> joints, replaced, springs, motors;
  for (const FrictionForJoint& friction : frictions) {
    joints.push_back(friction.joint);
    mjsJoint* joint = FindJoint(spec, friction.joint, place);
    if (ClearOwnFriction(*joint)) replaced.push_back(friction.joint);
    if (ClearPlasticSpring(*joint)) springs.push_back(friction.joint);
    if (ClearMotorDamping(spec, friction.joint)) motors.push_back(friction.joint);
    joint->damping[0] = JointFriction(friction.friction).viscous();
  }
  Note(replaced, "damping and frictionloss of the model were removed; the friction replaces them",
       notices);
  Note(springs,
       "the stiffness of the model's spring with a yield was removed, since it resists as dry "
       "friction does; the friction replaces it",
       notices);
  Note(motors, "damping of the actuators was removed; the friction replaces it", notices);
  // passive forces are not clipped by limits on actuators
  if (form == FrictionForm::actuator) MoveEffortLimits(spec, joints, place, notices);
}

std::vector<std::string> NoticesOfOthers(const mjModel* m,
                                         const std::vector<FrictionForJoint>& frictions) {
  // instances of plugins are not asked for tendons' lengths
  const ModelPtr bare(mj_copyModel(nullptr, m));
  bare->nplugin = 0;
  std::vector<std::string> notices;
  for (const FrictionForJoint& friction : frictions) {
    const int joint = mj_name2id(m, mjOBJ_JOINT, friction.joint.c_str());
    std::vector<std::string> others;
    for (int i = 0; i < m->nactuator; ++i) {
      const bool drives =
          m->actuator_trntype[i] == mjTRN_JOINT && m->actuator_trnid[2 * i] == joint;
      if (drives && HasOwnFriction(m, i)) {
        others.push_back(fmt::format("the friction of the dcmotor {}", ActuatorName(m, i)));
      }
    }
    for (int i = 0; i < m->ntendon; ++i) {
      const std::vector<const char*> resists = ResistanceOf(*m, i);
      if (resists.empty() || !Moves(bare.get(), i, joint)) continue;
      others.push_back(fmt::format("{} of tendon '{}'", fmt::join(resists, " and "),
                                   NameIn(m, mjOBJ_TENDON, i)));
    }
    if (others.empty()) continue;
    notices.push_back(
        fmt::format("{}: {} acts on it besides its friction, and stays; where the friction was "
                    "identified with it, take "
                    "it out of the model",
                    friction.joint, fmt::join(others, ", ")));
  }
  return notices;
}

}  // namespace warmjoint
