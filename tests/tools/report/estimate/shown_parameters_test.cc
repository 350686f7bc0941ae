#include "tools/report/estimate/shown_parameters.h"

#include <gtest/gtest.h>

namespace warmjoint {
namespace {

/// A joint that turns, with a law of which only `viscous` has an interval.
Estimate WithSharedLevel() {
  Estimate estimate;
  estimate.friction.emplace();
  estimate.friction->law = "viscous_coulomb";
  estimate.friction->parameters = {{"viscous", 2}, {"coulomb", 3}};
  estimate.parameters = {{"viscous", 2, "N.m.s/rad", 0.1, {{1.8, 2.2}}},
                         {"coulomb", 3, "N.m", {}, {}},
                         {"thermal_gain", -1, "N.m", {}, {}}};
  return estimate;
}

TEST(ShownParameters, AreAllWhereNoMapSharesTheLaw) {
  EXPECT_EQ(ShownParameters(WithSharedLevel()).size(), 3u);
}

TEST(ShownParameters, HaveFrictionAtSpeedsInPlaceOfWhatAMapShares) {
  Estimate estimate = WithSharedLevel();
  estimate.friction_at_speeds = {{0.3, 3.6, 0.05, {3.5, 3.7}, "rad/s", "N.m"}};
  const std::vector<EstimatedParameter> shown = ShownParameters(estimate);
  // what the data tell of the law, what is none of the law's, and the speed
  ASSERT_EQ(shown.size(), 3u);
  EXPECT_EQ(shown[0].name, "viscous");
  EXPECT_EQ(shown[1].name, "thermal_gain");
  EXPECT_EQ(shown[2].name, "friction forwards at 0.3 rad/s");
  EXPECT_EQ(shown[2].unit, "N.m");
  EXPECT_EQ(shown[2].value, 3.6);
  ASSERT_TRUE(shown[2].interval95);
  EXPECT_EQ((*shown[2].interval95)[1], 3.7);
}

TEST(ShownParameters, NameTheSpeedWithoutAUnitThatTheFileDoesNotTell) {
  Estimate estimate = WithSharedLevel();
  estimate.friction_at_speeds = {{0.25, 3.5, 0.05, {3.4, 3.6}}};
  EXPECT_EQ(ShownParameters(estimate).back().name, "friction forwards at 0.25");
}

}  // namespace
}  // namespace warmjoint
