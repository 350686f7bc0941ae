#include "sim/plant/single_joint_model.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "models/foundation/bad_input.h"
#include "sim/model/friction_actuator.h"
#include "sim/model/load_model.h"
#include "sim/model/spec_elements.h"
#include "sim/plugin/bound_joints.h"
#include "sim/plugin/stability.h"

namespace warmjoint {
namespace {

/// Removes all that acts on the robot, and every joint but one.
void KeepOnly(mjSpec* spec, mjsJoint* joint) {
  for (const mjtObj type : {mjOBJ_KEY, mjOBJ_SENSOR, mjOBJ_ACTUATOR, mjOBJ_EQUALITY, mjOBJ_TENDON,
                            mjOBJ_PAIR, mjOBJ_EXCLUDE}) {
    for (mjsElement* element : SpecElements(*spec, type)) mjs_delete(spec, element);
  }
  for (mjsElement* element : SpecElements(*spec, mjOBJ_JOINT)) {
    if (element != joint->element) mjs_delete(spec, element);
  }
}

void SetUp(mjSpec* spec, mjsJoint* joint, double timestep) {
  // nothing but the joint, its drive and its friction acts
  spec->compiler.fusestatic = 1;
  spec->option.timestep = timestep;
  spec->option.integrator = mjINT_EULER;
  spec->option.enableflags = 0;
  spec->option.disableflags = mjDSBL_CONSTRAINT | mjDSBL_CONTACT | mjDSBL_SENSOR | mjDSBL_EULERDAMP;
  std::fill(std::begin(joint->stiffness), std::end(joint->stiffness), 0.0);
  ClearOwnFriction(*joint);
  joint->actfrclimited = mjLIMITED_FALSE;
}

/// Steepest slope of gravity over the position of the one joint, N.m/rad. About a fixed axis gravity is
/// A sin(q + phase), so that two readings a quarter of a turn apart give A; along one it is constant.
double GravitySlope(const mjModel* m) {
  if (m->jnt_type[0] == mjJNT_SLIDE) return 0;
  const DataPtr data(mj_makeData(m));
  double squares = 0;
  for (const double angle : {0.0, std::numbers::pi / 2}) {
    data->qpos[0] = angle;
    mj_kinematics(m, data.get());
    mj_comPos(m, data.get());
    mjtNum gravity = 0;
    mj_rne(m, data.get(), 0, &gravity);
    squares += gravity * gravity;
  }
  return std::sqrt(squares);
}

void CheckPosition(const JointRoom& room, double position) {
  const auto [lower, upper] = room.limits;
  const double slack = 1e-9 * std::max(1.0, upper - lower);
  if (position >= lower - slack && position <= upper + slack) return;
  Refuse({room.scenario.name},
         "the motion takes joint '{}' to {:.4g}, beyond its limits {:.4g} to "
         "{:.4g}; let it travel between limits, or hold speeds for less time",
         room.scenario.joint, position, lower, upper);
}

}  // namespace

SingleJointModel LoadSingleJoint(const std::string& path, const std::string& joint,
                                 const Friction& friction, double timestep,
                                 const std::string& asked_by) {
  // the robot with one joint, and friction on it
  const ParsedModel parsed = ParseModel(path);
  mjSpec& spec = *parsed.spec;
  const Place place{fmt::format("{}: robot {}", asked_by, path)};
  mjsJoint* kept = FindJoint(spec, joint, place);
  KeepOnly(&spec, kept);
  SetUp(&spec, kept, timestep);
  AddFriction(spec, {{joint, friction}}, place);
  SingleJointModel result;
  result.model = CompileModel(spec, place);

  // what the plant needs to know, and where its numbers lie
  const mjModel* m = result.model.get();
  result.kind = m->jnt_type[0] == mjJNT_SLIDE ? JointKind::linear : JointKind::rotary;
  result.limits = m->jnt_limited[0] ? std::pair(m->jnt_range[0], m->jnt_range[1])
                                    : std::pair(-kInfinity, kInfinity);
  result.inertia = EffectiveInertia(m, 0);
  result.gravity_slope = GravitySlope(m);
  result.friction_actuator = m->actuator_outadr[0];
  result.friction_state = m->actuator_actadr[0];
  result.friction_control = m->actuator_ctrladr[0];
  result.friction_report = m->plugin_stateadr[m->actuator_plugin[0]] + kReportsPush;
  return result;
}

void CheckReach(const JointRoom& room, const std::vector<MotionSegment>& plan, double position) {
  // ends of segments are the extremes of a motion at constant speeds
  for (const MotionSegment& segment : plan) {
    position += segment.velocity * segment.duration;
    CheckPosition(room, position);
  }
}

void CheckReach(const JointRoom& room, const std::vector<VelocityCorner>& corners,
                double position) {
  const double end = room.scenario.duration;
  for (size_t i = 1; i < corners.size() && corners[i - 1].time < end; ++i) {
    // the path between two corners, of which the last may come after the end
    const VelocityCorner& from = corners[i - 1];
    VelocityCorner to = corners[i];
    if (to.time > end) {
      const double share = (end - from.time) / (to.time - from.time);
      to = {end, from.velocity + share * (to.velocity - from.velocity)};
    }
    // it is farthest where the joint turns back, or where it ends
    if (from.velocity * to.velocity < 0) {
      const double turn = from.velocity / (from.velocity - to.velocity) * (to.time - from.time);
      CheckPosition(room, position + turn * from.velocity / 2);
    }
    position += (to.time - from.time) * (from.velocity + to.velocity) / 2;
    CheckPosition(room, position);
  }

  // behind the last corner the speed stays
  const VelocityCorner& last = corners.back();
  CheckPosition(room, position + std::max(end - last.time, 0.0) * last.velocity);
}

}  // namespace warmjoint
