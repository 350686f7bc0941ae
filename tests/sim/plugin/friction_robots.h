// Robots that people know, with a load on every joint, for tests and tables of joints that stick.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "models/foundation/random_stream.h"
#include "sim/model/load_model.h"
#include "sim/model/spec_elements.h"
#include "tests/support/folders.h"

namespace warmjoint::test {

/// A robot's file below `robots` of the shared folder, and the armature (kg.m^2) of every joint
/// that its lightest needs to stick at 2 ms.
struct RobotCase {
  const char* file;
  double armature;

  /// The name of its folder.
  std::string name() const { return std::string(file).substr(0, std::string(file).find('/')); }
};

inline constexpr RobotCase kRobots[] = {
    {"franka_emika_panda/panda_nohand_nomesh.xml", 0},
    {"kuka_iiwa_14/iiwa14_nomesh.xml", 0.001},
    {"universal_robots_ur5e/ur5e_nomesh.xml", 0.002},
    {"abb_irb140_drake/irb140_inertial_com_shifted.urdf", 0.01},
    {"abb_yumi/yumi_nomesh.urdf", 0.007},
};

/// A robot without actuators, contacts and friction of its own, and a pose within its limits.
struct Robot {
  std::string path;
  SpecPtr spec;
  std::vector<double> pose;   // [nq] rad or m
  std::vector<double> level;  // [nv] 1.5 times the gravity load at the pose, and 2 N.m or N
};

/// armature: kg.m^2, at least, of every joint.
inline Robot LoadRobot(const std::string& file, double armature) {
  Robot robot{(SharedFolder() / "robots" / file).string(), nullptr, {}, {}};
  robot.spec = ParseModel(robot.path).spec;
  for (const mjtObj type :
       {mjOBJ_KEY, mjOBJ_SENSOR, mjOBJ_ACTUATOR, mjOBJ_EQUALITY, mjOBJ_TENDON}) {
    for (mjsElement* element : SpecElements(*robot.spec, type)) {
      mjs_delete(robot.spec.get(), element);
    }
  }
  for (mjsElement* element : SpecElements(*robot.spec, mjOBJ_JOINT)) {
    mjsJoint* joint = mjs_asJoint(element);
    joint->actfrclimited = mjLIMITED_FALSE;
    joint->frictionloss = 0;
    joint->armature = std::max(joint->armature, armature);
  }
  robot.spec->option.disableflags |= mjDSBL_CONTACT;

  // a pose drawn from the middle nine tenths of each range
  const ModelPtr m = CompileModel(*robot.spec, {robot.path});
  const DataPtr d(mj_makeData(m.get()));
  RandomStream random({1, 0}, Stream::test);
  for (int i = 0; i < m->njnt; ++i) {
    const double lower = m->jnt_limited[i] ? m->jnt_range[2 * i] : -3;
    const double upper = m->jnt_limited[i] ? m->jnt_range[2 * i + 1] : 3;
    d->qpos[i] = random.Uniform(lower + 0.05 * (upper - lower), upper - 0.05 * (upper - lower));
  }
  mj_forward(m.get(), d.get());
  robot.pose.assign(d->qpos, d->qpos + m->nq);
  for (int i = 0; i < m->nv; ++i) robot.level.push_back(1.5 * std::abs(d->qfrc_bias[i]) + 2);
  return robot;
}

}  // namespace warmjoint::test
