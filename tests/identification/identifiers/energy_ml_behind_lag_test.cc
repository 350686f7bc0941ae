#include "identification/identifiers/energy_ml_behind_lag.h"

#include <gmock/gmock.h>

#include "identification/answer/identify.h"
#include "identification/identifiers/energy_ml.h"
#include "identification/preparation/prepare.h"
#include "identification/read_options.h"
#include "tests/support/warm_recording.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

Fit Fitted(const Identifier& identifier, const std::map<std::string, std::string>& given) {
  const Measurements m =
      test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(1200, 3), 0.5, 3);
  const Options options = ReadOptions(identifier.options, given, {});
  return identifier.fit({Prepare(m), options, {}});
}

TEST(EnergyMlBehindLag, IsEnergyMlWhereNoLagIsAskedFor) {
  const Fit plain = Fitted(EnergyMl(), {}), same = Fitted(EnergyMlBehindLag(), {});
  ASSERT_FALSE(plain.refusal);
  EXPECT_EQ(same.fitted, plain.fitted);
  EXPECT_EQ(same.afterword, plain.afterword);
}

TEST(EnergyMlBehindLag, IsEnergyMlWhereTheLogShowsNoLagAndSaysSo) {
  const Fit plain = Fitted(EnergyMl(), {});
  const Fit asked = Fitted(EnergyMlBehindLag(), {{"torque_lag", "estimated"}});
  EXPECT_EQ(asked.fitted, plain.fitted);
  EXPECT_FALSE(asked.torque_lag);
  EXPECT_THAT(asked.afterword, HasSubstr("the torque shows no lag"));
}

TEST(EnergyMlBehindLag, RefusesALagUnderHubersLoss) {
  const Fit fit = Fitted(EnergyMlBehindLag(), {{"torque_lag", "estimated"}, {"loss", "huber"}});
  ASSERT_TRUE(fit.refusal);
  EXPECT_THAT(fit.refusal->message, HasSubstr("use loss squares, or torque_lag none"));
}

}  // namespace
}  // namespace warmjoint
