// Every robot of models/robots: its MJCF and its URDF are the same machine. The URDF is read twice,
// by MuJoCo and, independently, by urdfdom with the kinematics written here.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <vector>

#include "models/foundation/random_stream.h"
#include "models/robots/robot_folder.h"
#include "sim/model/load_model.h"

namespace warmjoint {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kGravity = 9.81;  // m/s^2, MuJoCo's default

Vector3d ToEigen(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

Isometry3d ToEigen(const urdf::Pose& pose) {
  const urdf::Rotation& r = pose.rotation;
  Isometry3d result(Eigen::Quaterniond(r.w, r.x, r.y, r.z));
  result.translation() = ToEigen(pose.position);
  return result;
}

/// Gravity torque of every joint by the lever of each mass beyond it.
class UrdfStatics {
 public:
  explicit UrdfStatics(const urdf::ModelInterface& robot) : robot_(robot) {}

  /// pose: joint positions by name. Returns the torque (force) that holds each joint, N.m or N.
  std::map<std::string, double> HoldingForce(const std::map<std::string, double>& pose) {
    pose_ = &pose;
    force_.clear();
    Visit(*robot_.getRoot(), Isometry3d::Identity());
    return force_;
  }

 private:
  struct Load {
    double mass = 0;                    // kg
    Vector3d moment{Vector3d::Zero()};  // mass times centre, kg.m, world frame
  };

  Load Visit(const urdf::Link& link, const Isometry3d& frame) {
    Load load;
    if (link.inertial) {
      load.mass = link.inertial->mass;
      load.moment = load.mass * (frame * ToEigen(link.inertial->origin.position));
    }
    for (const urdf::JointSharedPtr& joint : link.child_joints) {
      const Load beyond = VisitJoint(*joint, frame);
      load.mass += beyond.mass;
      load.moment += beyond.moment;
    }
    return load;
  }

  Load VisitJoint(const urdf::Joint& joint, const Isometry3d& parent) {
    Isometry3d frame = parent * ToEigen(joint.parent_to_joint_origin_transform);
    const Vector3d axis = frame.linear() * ToEigen(joint.axis);
    const Vector3d anchor = frame.translation();
    const bool slides = joint.type == urdf::Joint::PRISMATIC;
    if (slides) {
      frame.translate(pose_->at(joint.name) * ToEigen(joint.axis));
    } else if (joint.type != urdf::Joint::FIXED) {
      frame.rotate(Eigen::AngleAxisd(pose_->at(joint.name), ToEigen(joint.axis)));
    }
    const Load load = Visit(*robot_.getLink(joint.child_link_name), frame);
    if (joint.type == urdf::Joint::FIXED) return load;

    const Vector3d down(0, 0, -kGravity);
    const Vector3d lever = load.moment - load.mass * anchor;  // kg.m
    force_[joint.name] = slides ? -load.mass * axis.dot(down) : -axis.dot(lever.cross(down));
    return load;
  }

  const urdf::ModelInterface& robot_;
  const std::map<std::string, double>* pose_ = nullptr;
  std::map<std::string, double> force_;
};

/// Sets the pose by joint names; returns the holding force of each joint in MuJoCo.
std::map<std::string, double> HoldingForce(const mjModel* m, mjData* d,
                                           const std::map<std::string, double>& pose) {
  const auto id = [&](const std::string& name) { return mj_name2id(m, mjOBJ_JOINT, name.c_str()); };
  for (const auto& [name, position] : pose) d->qpos[m->jnt_qposadr[id(name)]] = position;
  mj_forward(m, d);
  std::map<std::string, double> force;
  for (const auto& [name, position] : pose) force[name] = d->qfrc_bias[m->jnt_dofadr[id(name)]];
  return force;
}

/// A pose within the joints' limits.
std::map<std::string, double> DrawPose(const RobotInfo& robot, RandomStream& random) {
  std::map<std::string, double> pose;
  for (const RobotJoint& joint : robot.joints) {
    pose[joint.name] = random.Uniform(joint.limits.first, joint.limits.second);
  }
  return pose;
}

class RobotContract : public testing::TestWithParam<RobotInfo> {
 protected:
  const RobotInfo& robot_ = GetParam();
  const LoadedModel mjcf_ = LoadModel(robot_.mjcf);
  const LoadedModel urdf_ = LoadModel(robot_.urdf);
  const urdf::ModelInterfaceSharedPtr urdfdom_ = ReadUrdf(robot_.urdf);

  int Joint(const mjModel* m, const std::string& name) const {
    return mj_name2id(m, mjOBJ_JOINT, name.c_str());
  }
};

TEST_P(RobotContract, DescribesItselfAndItsFriction) {
  EXPECT_FALSE(robot_.description.empty());
  EXPECT_FALSE(robot_.joints.empty());
  EXPECT_NE(robot_.friction.gear, 1) << "a geared motor";
  EXPECT_TRUE(mjcf_.notices.empty() && urdf_.notices.empty());
}

TEST_P(RobotContract, HasTheSameJointsInBothFiles) {
  const mjModel* a = mjcf_.model.get();
  ASSERT_EQ(a->njnt, static_cast<int>(robot_.joints.size()));
  for (int i = 0; i < a->njnt; ++i) {
    const RobotJoint& joint = robot_.joints[i];
    EXPECT_EQ(mj_id2name(a, mjOBJ_JOINT, i), joint.name);
    EXPECT_EQ(a->jnt_type[i], joint.kind == JointKind::linear ? mjJNT_SLIDE : mjJNT_HINGE);
    EXPECT_EQ(a->jnt_range[2 * i], joint.limits.first) << joint.name;
    EXPECT_EQ(a->jnt_range[2 * i + 1], joint.limits.second) << joint.name;
    EXPECT_GT(joint.speed, 0) << joint.name;
  }
}

TEST_P(RobotContract, HasAMotorOfTheSameEffortOnEachJoint) {
  const mjModel* m = mjcf_.model.get();
  for (const RobotJoint& joint : robot_.joints) {
    const int motor = mj_name2id(m, mjOBJ_ACTUATOR, joint.name.c_str());
    ASSERT_GE(motor, 0) << joint.name;
    EXPECT_EQ(m->actuator_trnid[2 * motor], Joint(m, joint.name));
    EXPECT_TRUE(m->actuator_forcelimited[motor]);
    EXPECT_EQ(m->actuator_forcerange[2 * motor + 1], joint.effort) << joint.name;
    EXPECT_EQ(m->actuator_forcerange[2 * motor], -joint.effort) << joint.name;
  }
}

TEST_P(RobotContract, HasTheSameMassesAndInertiasInBothFiles) {
  const mjModel* a = mjcf_.model.get();
  const mjModel* b = urdf_.model.get();
  for (const RobotJoint& joint : robot_.joints) {
    const int body = a->jnt_bodyid[Joint(a, joint.name)];
    const int twin = b->jnt_bodyid[Joint(b, joint.name)];
    const std::string link = mj_id2name(a, mjOBJ_BODY, body);
    EXPECT_EQ(link, mj_id2name(b, mjOBJ_BODY, twin));
    EXPECT_EQ(a->body_mass[body], b->body_mass[twin]) << link;
    EXPECT_EQ(a->body_mass[body], urdfdom_->getLink(link)->inertial->mass) << link;
    // the axes may be sorted differently; rounding of a rotation by quarter turns
    const mjtNum* inertia = a->body_inertia + 3 * body;
    const mjtNum* other = b->body_inertia + 3 * twin;
    std::vector<double> one(inertia, inertia + 3), two(other, other + 3);
    std::sort(one.begin(), one.end());
    std::sort(two.begin(), two.end());
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(one[i], two[i], 1e-14) << link;
  }
}

TEST_P(RobotContract, AgreesInAxesAndGravityAtRandomPoses) {
  const mjModel* a = mjcf_.model.get();
  const mjModel* b = urdf_.model.get();
  const DataPtr da(mj_makeData(a)), db(mj_makeData(b));
  UrdfStatics statics(*urdfdom_);
  RandomStream random({4, 0}, Stream::test);
  for (int trial = 0; trial < 100; ++trial) {
    const auto pose = DrawPose(robot_, random);
    const auto force_a = HoldingForce(a, da.get(), pose);
    const auto force_b = HoldingForce(b, db.get(), pose);
    const auto independent = statics.HoldingForce(pose);
    for (const RobotJoint& joint : robot_.joints) {
      // rounding of a few hundred operations on up to 100 kg times 1 m times g
      EXPECT_NEAR(force_a.at(joint.name), force_b.at(joint.name), 1e-10) << joint.name;
      EXPECT_NEAR(force_a.at(joint.name), independent.at(joint.name), 1e-10) << joint.name;
      const int i = 3 * Joint(a, joint.name), k = 3 * Joint(b, joint.name);
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(da->xaxis[i + axis], db->xaxis[k + axis], 1e-13) << joint.name;
        EXPECT_NEAR(da->xanchor[i + axis], db->xanchor[k + axis], 1e-13) << joint.name;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, RobotContract, testing::ValuesIn(Robots()),
                         [](const auto& robot) { return robot.param.name; });

}  // namespace
}  // namespace warmjoint
