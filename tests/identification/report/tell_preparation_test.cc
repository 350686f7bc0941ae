#include "identification/report/tell_preparation.h"

#include <gmock/gmock.h>

namespace warmjoint {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// Noise of the velocity that hides all of a slope, of a log at one speed.
constexpr VelocityNoise kHidesAll{0.02, 1, 0.5, 0.3};

Estimate Of(const char* law, const std::map<std::string, double>& parameters) {
  Estimate estimate;
  estimate.message = "fitted";
  estimate.friction = Friction{law, parameters, {}, 0, 1};
  for (const auto& [name, value] : parameters) {
    estimate.parameters.push_back({name, value, "", 0.1, {{value - 0.2, value + 0.2}}});
  }
  return estimate;
}

TEST(TellVelocity, SaysNothingOfASlopeThatTheLawDoesNotHave) {
  Estimate estimate = Of("coulomb", {{"coulomb", 2}});
  TellVelocity(kHidesAll, JointKind::rotary, estimate);
  EXPECT_EQ(estimate.message,
            "fitted; velocity averaged over each segment, for its noise of 0.02 rad/s");
  EXPECT_THAT(estimate.warnings, IsEmpty());
  EXPECT_EQ((*estimate.parameters[0].interval95)[0], 1.8);
}

TEST(TellVelocity, NamesTheSlopeByHowMuchItChanges) {
  Estimate estimate = Of("viscous_coulomb", {{"viscous", 5}, {"coulomb", 2}});
  TellVelocity({0.02, 0.25, 0.05, 0.3}, JointKind::rotary, estimate);
  EXPECT_THAT(estimate.message, HasSubstr("would change viscous by -25 %"));
  ASSERT_EQ(estimate.warnings.size(), 1u);
  EXPECT_THAT(estimate.warnings[0], HasSubstr("may still change viscous by -5 %"));
  // by 5 % of the slope, at the mean speed
  EXPECT_NEAR((*estimate.Find("viscous")->interval95)[0], 4.8 - 0.25, 1e-12);
  EXPECT_NEAR((*estimate.Find("coulomb")->interval95)[1], 2.2 + 0.25 * 0.3, 1e-12);
}

TEST(TellVelocity, NamesSlopesOfAMapOverSpeed) {
  Estimate estimate = Of("coulomb", {{"coulomb", 2}});
  FrictionMap map;
  map.axes.push_back({});
  map.axes[0].quantity = MapQuantity::velocity;
  estimate.friction->maps = {map};
  TellVelocity(kHidesAll, JointKind::rotary, estimate);
  EXPECT_THAT(estimate.message, HasSubstr("slopes over speed"));
}

}  // namespace
}  // namespace warmjoint
