#include "identification/identifiers/energy_ml_behind_lag.h"

#include <gmock/gmock.h>

#include "identification/identifiers/energy_ml.h"
#include "tests/identification/identifiers/fit_of_table_one.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

TEST(EnergyMlBehindLag, IsEnergyMlWhereNoLagIsAskedFor) {
  const Fit plain = test::FitOfTableOne(EnergyMl(), {}),
            same = test::FitOfTableOne(EnergyMlBehindLag(), {});
  ASSERT_FALSE(plain.refusal);
  EXPECT_EQ(same.fitted, plain.fitted);
  EXPECT_EQ(same.afterword, plain.afterword);
}

TEST(EnergyMlBehindLag, IsEnergyMlWhereTheLogShowsNoLagAndSaysSo) {
  const Fit plain = test::FitOfTableOne(EnergyMl(), {});
  const Fit asked = test::FitOfTableOne(EnergyMlBehindLag(), {{"torque_lag", "estimated"}});
  EXPECT_EQ(asked.fitted, plain.fitted);
  EXPECT_FALSE(asked.torque_lag);
  EXPECT_THAT(asked.afterword, HasSubstr("the torque shows no lag"));
}

TEST(EnergyMlBehindLag, RefusesALagUnderHubersLoss) {
  const Fit fit =
      test::FitOfTableOne(EnergyMlBehindLag(), {{"torque_lag", "estimated"}, {"loss", "huber"}});
  ASSERT_TRUE(fit.refusal);
  EXPECT_THAT(fit.refusal->message, HasSubstr("use loss squares, or torque_lag none"));
}

}  // namespace
}  // namespace warmjoint
