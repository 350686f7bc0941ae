#include "models/friction/bristle_course.h"

#include <gtest/gtest.h>

#include "models/friction/lugre.h"
#include "models/friction/lugre_bristle.h"
#include "tests/support/bristle_recording.h"

namespace warmjoint {
namespace {

/// F and s of a cold joint without maps at every sample of a motion that begins in steady sliding.
struct Run {
  Eigen::VectorXd force, load;  // [N] N.m
};
Run RunBristle(const MotionPieces& motion, const std::vector<double>& p) {
  BristleCourse<LuGre> course(p.data());
  Run run{Eigen::VectorXd(motion.size()), Eigen::VectorXd(motion.size())};
  for (Eigen::Index i = 0; i < motion.size(); ++i) {
    if (motion.Begins(i)) course.BeginSliding(motion.velocity(i), 0);
    for (const MotionPiece& piece : motion.Before(i)) course.Follow(piece, 0, 0);
    run.force[i] = course.Force(motion.velocity(i), 0);
    run.load[i] = course.load();
  }
  return run;
}

Eigen::VectorXd ForceAlong(const Friction& friction, const Measurements& m) {
  return RunBristle(MotionPieces(m.time, m.velocity, m.starts), LawValues(friction)).force;
}

TEST(BristleCourse, IsExactAtConstantSpeed) {
  // from rest to 0.1 rad/s at once: the step of the model itself, after one of the same travel
  Eigen::VectorXd velocity = Eigen::VectorXd::Constant(50, 0.1);
  velocity[0] = 0;
  const std::vector<double> p = LawValues(test::LuGreJoint());
  const MotionPieces pieces(0.01 * Eigen::VectorXd::LinSpaced(50, 0, 49), velocity, {});
  const Eigen::VectorXd load = RunBristle(pieces, p).load;
  double s = load[1];
  for (Eigen::Index i = 2; i < 50; ++i) {
    const auto level = [&](int side) { return LuGre::Level(side, 0.1, p.data()); };
    s = StepLugreBristle({p[4], p[5]}, s, 0.1, 0.01, level).load;
    // rounding of 50 steps at 20 N.m
    EXPECT_NEAR(load[i], s, 1e-12) << i;
  }
}

TEST(BristleCourse, FollowsAFinelySteppedBristleToSecondOrder) {
  double before = 0;
  for (const double rate : {25.0, 50.0, 100.0}) {
    const Measurements m =
        test::RecordBristle(test::LuGreJoint(), test::TurningMotion(60, 3), 60, rate, 0, 0, 3);
    const double error = (ForceAlong(test::LuGreJoint(), m) - m.torque).norm() /
                         std::sqrt(static_cast<double>(m.size()));
    // four times less with each halving, but for corners of the motion
    if (before > 0) {
      EXPECT_LT(error, before / 3) << rate;
    }
    before = error;
  }
  // a thousandth of the friction
  EXPECT_LT(before, 0.02);
}

TEST(BristleCourse, BendsAnewWithEachRecording) {
  const Measurements m =
      test::RecordBristle(test::LuGreJoint(), test::TurningMotion(20, 3), 20, 100, 0, 0, 3);
  const Eigen::VectorXd once = ForceAlong(test::LuGreJoint(), m);
  Measurements twice = m;
  twice.starts = {m.size()};
  for (Eigen::VectorXd* column : {&twice.time, &twice.velocity}) {
    const Eigen::VectorXd one = *column;
    column->resize(2 * m.size());
    *column << one, one;
  }
  twice.time.tail(m.size()).array() += 100;
  const Eigen::VectorXd force = ForceAlong(test::LuGreJoint(), twice);
  // rounding of times of 100 s, at 2000 N.m/rad and 1 rad/s
  EXPECT_LT((force.head(m.size()) - once).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((force.tail(m.size()) - once).cwiseAbs().maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace warmjoint
