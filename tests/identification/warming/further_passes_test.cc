#include "identification/warming/further_passes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "identification/linear/linear_laws.h"
#include "tests/support/warm_recording.h"
#include "tests/support/without_times.h"

namespace warmjoint {
namespace {

/// Warms for 900 s, rests for 3000 s of which there is no log, and warms again for 2700 s.
Measurements CooledInAGap(std::uint64_t seed) {
  Eigen::VectorXd velocity = test::AlternatingSpeeds(6600, seed);
  velocity.segment(900, 3000).setZero();
  return test::Without(test::RecordFriction(test::TableOne(), 1, velocity, 0.5, seed),
                       {{899.5, 3900.5}});
}

TEST(FitJumps, TakesAJointThatCooledInAGapForNoWarmStart) {
  const Measurements m = CooledInAGap(1);
  ClosedLoop loop = ClosedLoop::Along(m, LawColumns(*FindLaw("viscous_coulomb"), m.velocity));
  const Eigen::VectorXd level = loop.direction().cwiseProduct(m.torque);
  const Eigen::VectorXd kept = Eigen::VectorXd::Ones(m.size());
  const Eigen::MatrixXd none(m.size(), 0);
  const WarmStart scanned = ScanTimeConstant(loop, level, kept);

  // a fit that went astray: E follows the loss at once, which no step undoes
  WarmFit fit = FitWarmFriction(loop, level, none, kept, scanned, InitialEnergy::estimated, 1);
  fit.solution.x.segment(2, 3) << 0.06, std::log(1e-20), 8;
  FitJumps(loop, level, none, kept, FindGaps(m), scanned, fit);
  ASSERT_TRUE(fit.converged);
  // standard errors of such a log are some 0.1 N.m/W and 30 s
  EXPECT_NEAR(fit.thermal().gain, -3, 0.4);
  EXPECT_NEAR(fit.thermal().time_constant, 600, 120);
  EXPECT_EQ(fit.jump_values().size(), 1);
}

}  // namespace
}  // namespace warmjoint
