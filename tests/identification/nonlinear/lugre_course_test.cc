#include "identification/nonlinear/lugre_course.h"

#include <gtest/gtest.h>
#include <warmjoint/friction.h>

#include "tests/support/bristle_recording.h"

namespace warmjoint {
namespace {

/// Two runs of a joint with a bristle, whose torque is the law's from given loads.
LugreProblem Problem(const LugrePoint& truth, const std::vector<double>& loads) {
  const test::TurningMotion motion(8, 3);
  const Eigen::Index n = 400;
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(2 * n, 0, 7.99);
  LugreProblem problem{MotionPieces(time, time.unaryExpr(motion), {n}),
                       Eigen::VectorXd::LinSpaced(2 * n, -1, 1),
                       {},
                       {Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(2 * n, true), {}},
                       Eigen::VectorXd::Constant(2 * n, 0.5),
                       {}};
  problem.torque = LugreTorque(problem, truth, loads);
  return problem;
}

LugrePoint Truth() {
  LugrePoint truth{Eigen::VectorXd(7)};
  truth.x << 5, 15, 20, std::log(0.05), std::log(2000.0), 40, 0.3;
  return truth;
}

TEST(LugreCourse, FindsTheLoadsThatRecordingsBeginWith) {
  const LugrePoint truth = Truth();
  const LugreProblem problem = Problem(truth, {-7, 11});
  const LugreCourse<double> course = FollowLugre<LuGre>(problem, truth.x.data());
  ASSERT_EQ(course.loads.size(), 2u);
  // 1e-3: the prior of the torque's rms, some 15 N.m, against hundreds of samples known to 0.5
  EXPECT_NEAR(course.loads[0], -7, 7e-3);
  EXPECT_NEAR(course.loads[1], 11, 11e-3);
  for (Eigen::Index i = 0; i < problem.torque.size(); ++i) {
    EXPECT_NEAR(course.torque[static_cast<size_t>(i)], problem.torque[i], 11e-3) << i;
  }
}

TEST(LugreCourse, KeepsALoadThatNoSampleTellsAtNothing) {
  const LugrePoint truth = Truth();
  LugreProblem problem = Problem(truth, {-7, 11});
  problem.used.keep.head(400).setConstant(false);
  EXPECT_EQ(FollowLugre<LuGre>(problem, truth.x.data()).loads[0], 0);
}

}  // namespace
}  // namespace warmjoint
