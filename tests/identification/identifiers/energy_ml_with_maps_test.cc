#include "identification/identifiers/energy_ml_with_maps.h"

#include <gmock/gmock.h>

#include "identification/identifiers/energy_ml.h"
#include "identification/identifiers/energy_ml_behind_lag.h"
#include "tests/identification/identifiers/fit_of_table_one.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

TEST(EnergyMlWithMaps, IsEnergyMlWhereNoMapIsAskedFor) {
  const Fit plain = test::FitOfTableOne(EnergyMl(), {}),
            same = test::FitOfTableOne(EnergyMlWithMaps(), {});
  ASSERT_FALSE(plain.refusal);
  EXPECT_EQ(same.identifier, plain.identifier);
  EXPECT_EQ(same.fitted, plain.fitted);
  EXPECT_TRUE(same.friction.maps.empty());
}

TEST(EnergyMlWithMaps, HasTheOptionsOfEnergyMlThenThoseOfMaps) {
  const std::vector<OptionInfo> plain = EnergyMlBehindLag().options,
                                all = EnergyMlWithMaps().options;
  ASSERT_GT(all.size(), plain.size());
  for (size_t i = 0; i < plain.size(); ++i) EXPECT_EQ(all[i].name, plain[i].name);
  EXPECT_EQ(all[plain.size()].name, "position");
}

TEST(EnergyMlWithMaps, RefusesALagBesideMaps) {
  const Fit fit =
      test::FitOfTableOne(EnergyMlWithMaps(), {{"position", "map"}, {"torque_lag", "estimated"}});
  ASSERT_TRUE(fit.refusal);
  EXPECT_EQ(fit.refusal->status, Status::bad_data);
  EXPECT_THAT(fit.refusal->message, HasSubstr("use position none, or torque_lag none"));
}

}  // namespace
}  // namespace warmjoint
