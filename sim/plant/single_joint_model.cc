#include "sim/plant/single_joint_model.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "models/foundation/bad_input.h"
#include "sim/model/friction_actuator.h"
#include "sim/model/joint_pattern.h"
#include "sim/model/load_model.h"
#include "sim/model/spec_elements.h"
#include "sim/plugin/check_joint.h"
#include "sim/plugin/friction_instance.h"

namespace warmjoint::inline sim {
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

}  // namespace warmjoint::inline sim
