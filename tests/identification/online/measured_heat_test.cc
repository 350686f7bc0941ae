#include "identification/online/measured_heat.h"

#include <gtest/gtest.h>

#include "tests/support/warm_recording.h"

namespace warmjoint {
namespace {

TEST(MeasuredHeat, LeavesTheColdLawOfAWarmTorque) {
  const Measurements m =
      test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(600, 1), 0, 1);
  const Eigen::VectorXd cold = MeasuredHeat(m, *test::TableOne().thermal).TakenOff(m.torque);
  const Eigen::VectorXd law = 5 * m.velocity + 15 * m.velocity.array().sign().matrix();
  // 1e-12: the same filter twice, 600 steps
  EXPECT_LT((cold - law).cwiseAbs().maxCoeff(), 1e-12 * 20);
}

TEST(MeasuredHeat, TransposedIsItsAdjoint) {
  const Measurements m =
      test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(600, 1), 0.5, 1);
  const MeasuredHeat heat(m, *test::TableOne().thermal);
  const Eigen::VectorXd weights = Eigen::VectorXd::LinSpaced(m.size(), -1, 2);
  const double forwards = weights.dot(heat.TakenOff(m.torque).col(0));
  // 1e-12: sums of 600 products
  EXPECT_NEAR(heat.Transposed(weights).col(0).dot(m.torque), forwards, 1e-12 * 600 * 20);
}

}  // namespace
}  // namespace warmjoint
