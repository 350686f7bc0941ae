#include "identification/identifiers/auto.h"

#include <gmock/gmock.h>

#include "identification/answer/identify.h"
#include "identification/preparation/select.h"
#include "tests/support/slow_recording.h"

namespace warmjoint {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

Estimate Answer(const Measurements& m) {
  const Identifier identifier = Auto();
  const Options options(identifier.options, {}, {});
  return IdentifyUnjudged(identifier, {Prepare(m), options, {}});
}

/// How many of 10 realizations choose that law, with that warming.
int Chosen(const FrictionDescription& truth) {
  int chosen = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Eigen::VectorXd velocity = truth.law == "stribeck" ? test::SlowAndFast(3600, seed)
                                                             : test::AlternatingSpeeds(3600, seed);
    const Estimate estimate = Answer(test::RecordFriction(truth, 1, velocity, 0.5, seed));
    if (!estimate.friction) continue;
    chosen += estimate.friction->law == truth.law && estimate.friction->maps.empty() &&
              estimate.friction->thermal.has_value() == truth.thermal.has_value();
  }
  return chosen;
}

// at least 90 %
constexpr int kAtLeast = 9;

TEST(Auto, ChoosesWarmingForTableOne) { EXPECT_GE(Chosen(test::TableOne()), kAtLeast); }

TEST(Auto, ChoosesNoWarmingForAColdJoint) {
  FrictionDescription cold = test::TableOne();
  cold.thermal.reset();
  EXPECT_GE(Chosen(cold), kAtLeast);
}

TEST(Auto, ChoosesALevelForEachDirectionWhereTheyDiffer) {
  // by 0.2 N.m, ten standard deviations
  EXPECT_GE(Chosen({"asymmetric",
                    {{"viscous", 5}, {"coulomb_positive", 15.1}, {"coulomb_negative", 14.9}},
                    Thermal{-3, 600}}),
            kAtLeast);
}

TEST(Auto, ChoosesTheStribeckLawWhereSlowSpeedsShowIt) {
  EXPECT_GE(Chosen(test::StribeckJoint()), kAtLeast);
}

TEST(Auto, SaysWhyAndListsWhatItTried) {
  const Estimate estimate =
      Answer(test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(3600, 1), 0.5, 1));
  EXPECT_EQ(estimate.identifier, "auto");
  EXPECT_THAT(estimate.message,
              AllOf(HasSubstr("chose energy-ml law=viscous_coulomb: RMSE 0."),
                    HasSubstr("; nominal-ls law=coulomb "),
                    HasSubstr("energy-ml law=asymmetric (outdone by energy-ml law=viscous_coulomb"),
                    HasSubstr("stribeck warming=none")));
}

}  // namespace
}  // namespace warmjoint
