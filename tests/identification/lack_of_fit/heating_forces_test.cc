#include "identification/lack_of_fit/heating_forces.h"

#include <gtest/gtest.h>

#include "identification/linear/linear_laws.h"
#include "tests/support/warm_recording.h"

namespace warmjoint {
namespace {

/// Drifts by their formula, each sample a bin, of a friction without gain: what heats changes nothing. [N x kCourses]
Eigen::MatrixXd Drifts(const Measurements& m) {
  const Eigen::ArrayXd t = (m.time.array() - m.time[0]) / (m.time[m.size() - 1] - m.time[0]);
  const Eigen::ArrayXd sign = m.velocity.array().sign();
  Eigen::MatrixXd drifts(m.size(), kCourses);
  drifts.col(0) = sign * t;
  double rate = 2;
  for (Eigen::Index k = 1; k < kCourses; ++k, rate *= 2) {
    drifts.col(k) = sign * (1 - (-rate * t).exp()) / (1 - std::exp(-rate));
  }
  return drifts;
}

/// What HeatingForcesOf makes of the same.
Eigen::MatrixXd Made(const Measurements& m) {
  Friction friction = test::TableOne();
  friction.thermal->gain = 0;
  FittedModel model;
  model.thermal = friction.thermal;
  model.energy = Eigen::VectorXd::Zero(m.size());
  model.loop = ClosedLoop::Along(m, LawColumns(*FindLaw(friction.law), m.velocity));
  Bins bins;
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    bins.begin.push_back(i);
    bins.end.push_back(i + 1);
  }
  bins.weight = Eigen::VectorXd::Ones(m.size());
  return HeatingForcesOf(model, m, bins).drifts;
}

TEST(HeatingForces, DriftsDieAwayOverAnyClock) {
  Measurements m =
      test::RecordFriction(test::TableOne(), 0.1, test::AlternatingSpeeds(3001, 1), 0, 1);
  m.time.array() += 5;
  // 1e-14: some 15 products of numbers up to 1
  EXPECT_LT((Made(m) - Drifts(m)).cwiseAbs().maxCoeff(), 1e-14);
  // a pause in it, and every step another one
  m.time.tail(1000).array() += 70;
  EXPECT_LT((Made(m) - Drifts(m)).cwiseAbs().maxCoeff(), 1e-14);
  m.time = (m.time / 30).array().square();
  EXPECT_LT((Made(m) - Drifts(m)).cwiseAbs().maxCoeff(), 1e-14);
}

}  // namespace
}  // namespace warmjoint
