#include "identification/describe_friction.h"

#include <gmock/gmock.h>

#include "identification/identifier.h"
#include "identification/preparation/select.h"
#include "tests/support/warm_recording.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

/// An estimate of law (2) with these values, which are known to +- 0.1.
Estimate Values(double viscous, double coulomb) {
  Estimate estimate;
  estimate.message = "fitted";
  estimate.parameters = {{"viscous", viscous, "N.m.s/rad", 0.05, {{viscous - 0.1, viscous + 0.1}}},
                         {"coulomb", coulomb, "N.m", 0.05, {{coulomb - 0.1, coulomb + 0.1}}}};
  return estimate;
}

Estimate Described(Estimate estimate) {
  DescribeFriction(*FindLaw("viscous_coulomb"), {}, estimate);
  return estimate;
}

TEST(DescribeFriction, GivesTheFrictionOfValuesWithinTheirBounds) {
  const Estimate estimate = Described(Values(0, 2));
  ASSERT_TRUE(estimate.friction);
  EXPECT_EQ(estimate.friction->parameters.at("coulomb"), 2);
  EXPECT_EQ(estimate.FullMessage(), "fitted");
}

TEST(DescribeFriction, WarnsWhereTheIntervalReachesTheBound) {
  const Estimate estimate = Described(Values(-0.05, 2));
  EXPECT_EQ(estimate.status, Status::ok);
  EXPECT_FALSE(estimate.friction);
  EXPECT_EQ(estimate.message, "fitted");
  ASSERT_EQ(estimate.warnings.size(), 1u);
  EXPECT_EQ(estimate.warnings[0],
            "viscous is -0.05 N.m.s/rad, below its bound 0, but for a part of its 95 % interval, "
            "-0.15 to 0.05: no friction is given; record longer, or try law coulomb");
}

TEST(DescribeFriction, WarnsOfEachValueWithoutAnInterval) {
  Estimate estimate = Values(-3, -2);
  for (EstimatedParameter& parameter : estimate.parameters) parameter.interval95.reset();
  estimate = Described(estimate);
  EXPECT_EQ(estimate.status, Status::ok);
  EXPECT_FALSE(estimate.friction);
  ASSERT_EQ(estimate.warnings.size(), 2u);
  EXPECT_THAT(estimate.warnings[1], HasSubstr("coulomb is -2 N.m, below its bound 0, with no"));
}

TEST(DescribeFriction, VoidsTheEstimateWhoseIntervalIsWhollyOutside) {
  const Estimate estimate = Described(Values(0.5, -2));
  EXPECT_EQ(estimate.status, Status::inadequate_model);
  EXPECT_FALSE(estimate.Find("coulomb")->interval95);
  EXPECT_THAT(estimate.message,
              HasSubstr("coulomb is -2 N.m, below its bound 0, with its whole 95 % interval, -2.1 "
                        "to -1.9: law viscous_coulomb does not describe these data; "));
  EXPECT_TRUE(estimate.warnings.empty());
}

TEST(DescribeFriction, DoesNotLetFrictionRiseFromRest) {
  Estimate estimate = Values(1, 2);
  estimate.parameters.push_back({"static", 1.5, "N.m", {}, {}});
  DescribeFriction(*FindLaw("stiction"), {}, estimate);
  EXPECT_EQ(estimate.status, Status::inadequate_model);
  EXPECT_THAT(estimate.message, HasSubstr("static is below coulomb"));
}

TEST(DescribeFriction, SeldomVoidsTheRightModelAtItsBound) {
  // without viscous friction half of the values fall below 0, and 2.5 % with their whole interval
  FrictionDescription friction{"viscous_coulomb", {{"viscous", 0}, {"coulomb", 15}}, {}, 0, 1};
  const Identifier& identifier = FindIdentifier("nominal-ls");
  const Options options(identifier.options, {}, {});
  int below = 0, voided = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const Measurements m =
        test::RecordFriction(friction, 1, test::AlternatingSpeeds(400, seed), 0.5, seed);
    const Selection selection = SelectMoving(m);
    const Estimate estimate = identifier.identify({m, selection, options, {}});
    voided += estimate.status == Status::inadequate_model;
    below += !estimate.friction;
  }
  // binomial: 200 +- 3 x 10, and 10 + 3 x 3.1
  EXPECT_NEAR(below, 200, 30);
  EXPECT_LE(voided, 20);
}

}  // namespace
}  // namespace warmjoint
