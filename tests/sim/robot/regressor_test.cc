// The rigid part of a robot: the regressor against MuJoCo's inverse dynamics, and what is mended of a description.
#include "sim/robot/regressor.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "models/robots/robot_folder.h"
#include "sim/robot/description.h"
#include "tests/support/refusal.h"

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr Index kSamples = 20;

/// mj_inverse of the logged joints, the others at rest at 0. [N x n]
Eigen::MatrixXd InverseDynamics(const RobotDescription& robot, const Eigen::MatrixXd& q,
                                const Eigen::MatrixXd& v, const Eigen::MatrixXd& a) {
  const DataPtr data(mj_makeData(robot.model.get()));
  Eigen::MatrixXd torque(q.rows(), q.cols());
  for (Index i = 0; i < q.rows(); ++i) {
    for (Index j = 0; j < q.cols(); ++j) {
      const ModelJoint& joint = robot.joints[static_cast<std::size_t>(j)];
      data->qpos[joint.qpos] = q(i, j);
      data->qvel[joint.dof] = v(i, j);
      data->qacc[joint.dof] = a(i, j);
    }
    mj_inverse(robot.model.get(), data.get());
    for (Index j = 0; j < q.cols(); ++j) {
      torque(i, j) = data->qfrc_inverse[robot.joints[static_cast<std::size_t>(j)].dof];
    }
  }
  return torque;
}

Eigen::MatrixXd Uniform(Index columns, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-2, 2);
  return Eigen::MatrixXd::NullaryExpr(kSamples, columns, [&] { return uniform(random); });
}

/// Largest deviation of Y phi from mj_inverse, as a share of the largest torque.
double WorstDeviation(const RobotDescription& robot) {
  const Index n = std::ssize(robot.joints);
  const Eigen::MatrixXd q = Uniform(n, 1), v = Uniform(n, 2), a = Uniform(n, 3);
  const RobotMotion motion(robot, q, v, a);
  const Eigen::MatrixXd expected = InverseDynamics(robot, q, v, a);
  double worst = 0;
  for (Index j = 0; j < n; ++j) {
    const Eigen::VectorXd torque = motion.Regressor(j, Accelerations::counted) * robot.Parameters();
    worst = std::max(worst, (torque - expected.col(j)).cwiseAbs().maxCoeff());
  }
  return worst / expected.cwiseAbs().maxCoeff();
}

RobotDescription Describe(const std::filesystem::path& file,
                          const std::vector<std::string>& joints = {}) {
  ReadModel read = ReadRobotModel(file);
  const std::vector<std::string> all = joints.empty() ? read.joints : joints;
  return DescribeRobot(std::move(read), all);
}

TEST(RobotRegressor, IsInverseDynamicsOfEveryRobot) {
  for (const RobotInfo& robot : Robots()) {
    EXPECT_LT(WorstDeviation(Describe(robot.mjcf)), 1e-13) << robot.mjcf;
    EXPECT_LT(WorstDeviation(Describe(robot.urdf)), 1e-13) << robot.urdf;
  }
}

TEST(RobotRegressor, MergesWhatStandsStill) {
  for (const RobotInfo& robot : Robots()) {
    ReadModel read = ReadRobotModel(robot.mjcf);
    if (read.joints.size() < 3) continue;
    // the second joint stands still, and the others are logged in another order
    std::vector<std::string> joints(read.joints.rbegin(), read.joints.rend());
    std::erase(joints, read.joints[1]);
    const RobotDescription part = DescribeRobot(std::move(read), joints);
    EXPECT_EQ(part.links.size(), joints.size());
    EXPECT_LT(WorstDeviation(part), 1e-13) << robot.mjcf;
  }
}

TEST(RobotRegressor, LeavesAccelerationOut) {
  const RobotDescription robot = Describe(Robots().front().mjcf);
  const Index n = std::ssize(robot.joints);
  const Eigen::MatrixXd q = Uniform(n, 1), v = Uniform(n, 2), a = Uniform(n, 3);
  const RobotMotion motion(robot, q, v, a), still(robot, q, v, 0 * a);
  for (Index j = 0; j < n; ++j) {
    const Eigen::MatrixXd left_out = motion.Regressor(j, Accelerations::left_out);
    EXPECT_TRUE(left_out.isApprox(still.Regressor(j, Accelerations::counted), 1e-12));
  }
}

TEST(RobotRegressor, IsLinearInGravity) {
  RobotDescription robot = Describe(Robots().front().mjcf);
  const Index n = std::ssize(robot.joints);
  const Eigen::MatrixXd q = Uniform(n, 1), v = Uniform(n, 2), a = Uniform(n, 3);
  const RobotMotion upright(robot, q, v, a);
  // a base on a wall
  ReadModel read = ReadRobotModel(Robots().front().mjcf);
  const Eigen::Vector3d before = Eigen::Map<const Eigen::Vector3d>(read.model->opt.gravity);
  const Eigen::Vector3d after(3, 9, -1);
  std::ranges::copy(after, read.model->opt.gravity);
  const std::vector<std::string> all = read.joints;
  const RobotMotion turned(DescribeRobot(std::move(read), all), q, v, a);
  for (Index j = 0; j < n; ++j) {
    const Eigen::MatrixXd sum =
        upright.Regressor(j, Accelerations::counted) +
        upright.GravityRegressor(Eigen::VectorXd::Unit(n, j), after - before);
    EXPECT_TRUE(sum.isApprox(turned.Regressor(j, Accelerations::counted), 1e-12)) << j;
  }
}

TEST(RobotRegressor, PutsStillJointsWhereTheyStand) {
  // a torque at a place of all joints is that of the same place with one of them still
  const std::vector<RobotInfo> robots = Robots();
  const auto arm = std::ranges::find_if(
      robots, [](const RobotInfo& robot) { return ReadRobotModel(robot.mjcf).joints.size() > 3; });
  const std::filesystem::path& file = arm->mjcf;
  const RobotDescription whole = Describe(file);
  const Index n = std::ssize(whole.joints);
  Eigen::MatrixXd q = Uniform(n, 1), v = Uniform(n, 2), a = Uniform(n, 3);
  constexpr double place = .7;
  q.col(1).setConstant(place);
  v.col(1).setZero();
  a.col(1).setZero();
  const Eigen::MatrixXd expected = InverseDynamics(whole, q, v, a);
  ReadModel read = ReadRobotModel(file);
  std::vector<std::string> joints = read.joints;
  const std::string still = joints[1];
  joints.erase(joints.begin() + 1);
  const RobotDescription part = DescribeRobot(std::move(read), joints, {{still, place}});
  const auto rest = [&](const Eigen::MatrixXd& x) {
    Eigen::MatrixXd left(x.rows(), n - 1);
    left << x.col(0), x.rightCols(n - 2);
    return left;
  };
  const RobotMotion motion(part, rest(q), rest(v), rest(a));
  for (Index j = 0; j < n - 1; ++j) {
    const Eigen::VectorXd torque = motion.Regressor(j, Accelerations::counted) * part.Parameters();
    EXPECT_TRUE(torque.isApprox(rest(expected).col(j), 1e-9)) << j;
  }
  read = ReadRobotModel(file);
  EXPECT_THROW(DescribeRobot(std::move(read), joints, {{joints[0], place}}), BadInput);
}

TEST(RobotRegressor, KeepsTheDirectionsThatTorqueSees) {
  // a prior along them makes the same torque as one of all parameters
  const RobotDescription robot = Describe(Robots().front().mjcf);
  const Index n = std::ssize(robot.joints);
  const RobotMotion motion(robot, Uniform(n, 1), Uniform(n, 2), Uniform(n, 3));
  const Eigen::MatrixXd y = motion.Regressor(Index{0}, Accelerations::counted);
  const Eigen::VectorXd deviations = .1 * robot.Spreads();
  const Eigen::MatrixXd basis = DirectionsSeen(y, deviations).basis;
  const Eigen::MatrixXd scaled = y * deviations.asDiagonal(), seen = y * basis;
  EXPECT_LT(basis.cols(), y.cols());
  EXPECT_TRUE((seen * seen.transpose()).isApprox(scaled * scaled.transpose(), 1e-6));
}

class RobotDescriptionFile : public testing::Test {
 protected:
  std::string Write(const std::string& text) {
    const std::string file = testing::TempDir() +
                             testing::UnitTest::GetInstance()->current_test_info()->name() +
                             "_mended.urdf";
    std::ofstream(file) << text;
    return file;
  }
};

constexpr const char* kBroken = R"(<robot name="r"><link name="base"/>
<link name="a"><inertial><origin xyz="0 0 .1"/><mass value="2"/>
<inertia ixx=".1" iyy=".1" izz=".5" ixy="0" ixz="0" iyz="0"/></inertial>
<visual><geometry><mesh filename="package://nowhere/a.dae"/></geometry></visual></link>
<link name="b"/>
<joint name="turns" type="revolute"><parent link="base"/><child link="a"/><axis xyz="0 1 0"/>
<limit lower="-1" upper="1" effort="1" velocity="1"/><dynamics damping="3" friction="1"/></joint>
<joint name="carries" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 1 0"/></joint>
<transmission name="t"><type>x</type></transmission></robot>)";

TEST_F(RobotDescriptionFile, IsMendedAndSaysSo) {
  const RobotDescription robot = Describe(Write(kBroken));
  ASSERT_EQ(robot.joints.size(), 2U);
  EXPECT_EQ(robot.joints[0].range, (std::array<double, 2>{-1, 1}));
  EXPECT_FALSE(robot.joints[1].range);
  EXPECT_LT(WorstDeviation(robot), 1e-13);
  std::string said;
  for (const std::string& notice : robot.notices) said += notice + "\n";
  EXPECT_NE(said.find("inertia that no body can have"), std::string::npos) << said;
  EXPECT_NE(said.find("without a mass of their own, taken as massless: b"), std::string::npos);
}

TEST_F(RobotDescriptionFile, WithAnInertiaBelowZeroIsRefusedByLinkAndValue) {
  std::string text = kBroken;
  text.replace(text.find("izz=\".5\""), 8, "izz=\"-.5\"");
  const std::string refusal = test::RefusalOf([&] { ReadRobotModel(Write(text)); });
  for (const char* part : {":3: ", "link 'a'", "izz", "'-.5'", "0 or more"}) {
    EXPECT_NE(refusal.find(part), std::string::npos) << refusal;
  }
}

TEST_F(RobotDescriptionFile, SaysWhichLimitsAreTurned) {
  std::string text = kBroken;
  text.replace(text.find("lower=\"-1\""), 10, "lower=\"2\"");
  const RobotDescription robot = Describe(Write(text));
  EXPECT_FALSE(robot.joints[0].range);
  std::string said;
  for (const std::string& notice : robot.notices) said += notice + "\n";
  EXPECT_NE(said.find("lower limit is above the upper one"), std::string::npos) << said;
}

TEST_F(RobotDescriptionFile, NamesTheNearestJoint) {
  ReadModel read = ReadRobotModel(Write(kBroken));
  EXPECT_THROW(DescribeRobot(std::move(read), {"turn"}), BadInput);
}

}  // namespace
}  // namespace warmjoint
