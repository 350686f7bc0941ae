// A real ball screw, EMPS (Janot, Gautier, Brunot 2019): what its log of 25 s shows beyond a law.
#include <gmock/gmock.h>
#include <warmjoint/prepared_log.h>

#include <numbers>

#include "identification/holdout/hold_out.h"
#include "identification/identifiers/identifier_list.h"
#include "tests/support/emps_log.h"
#include "tests/support/judging.h"

namespace warmjoint {
namespace {

using ::testing::ContainsRegex;

/// The log; a turn of its screw is 10 mm.
Measurements Emps() {
  Measurements m = test::EmpsLog();
  m.gear = 2 * std::numbers::pi / 0.010;
  return m;
}

/// Figures on the last 40 % of the time, of a fit to the first 60 %, N.
double TestRmse(const Measurements& m, const std::string& name,
                const std::map<std::string, std::string>& given) {
  const Identifier& identifier = FindIdentifier(name);
  const Options options = identifier.options.Read(given);
  const auto held = HoldOut(identifier, {Prepare(m), options, {}}, 0.4).metrics;
  return held ? held->rmse : kInfinity;
}

// one unit of the last digit of published figures, which another selection of samples moves
TEST(Emps, HasThePublishedNumbersOfTheAsymmetricLaw) {
  WARMJOINT_NEED_SHARED(test::kEmpsFile);
  const Estimate estimate = test::Fitted("nominal-ls", Emps(), {{"law", "asymmetric"}});
  EXPECT_NEAR(estimate.Find("viscous")->value, 193, 2);
  EXPECT_NEAR(estimate.Find("coulomb_positive")->value, 18.0, 0.1);
  EXPECT_NEAR(estimate.Find("coulomb_negative")->value, 25.2, 0.1);
  EXPECT_EQ(estimate.Find("coulomb_positive")->unit, "N");
  EXPECT_NEAR(estimate.metrics->rmse, 1.78, 0.02);
  EXPECT_NEAR(estimate.metrics->fit, 95.5, 0.1);
}

TEST(Emps, PositionForEachDirectionBeatsTheAsymmetricLawOnTheTestPart) {
  WARMJOINT_NEED_SHARED(test::kEmpsFile);
  const Measurements m = Emps();
  const double law = TestRmse(m, "nominal-ls", {{"law", "asymmetric"}});
  // the map takes most of what law (3) leaves, the drift of 25 s stays: at least a quarter less
  EXPECT_LT(TestRmse(m, "position-ridge", {}), 0.75 * law);
  EXPECT_LT(TestRmse(m, "motor-ridge", {}), 0.75 * law);
}

TEST(Emps, RipplesFourTimesATurnOfTheScrew) {
  WARMJOINT_NEED_SHARED(test::kEmpsFile);
  const Estimate estimate = test::Fitted("motor-ridge", Emps());
  // 2.50 mm, strongest in both directions
  EXPECT_THAT(estimate.message, ContainsRegex("v > 0: [0-9.]+ N at 4 a turn"));
  EXPECT_THAT(estimate.message, ContainsRegex("v < 0: [0-9.]+ N at 4 a turn"));
}

TEST(Emps, HasThePublishedOffsetOfGravity) {
  WARMJOINT_NEED_SHARED(test::kEmpsFile);
  const Estimate estimate = test::Fitted("nominal-ls", test::EmpsLog(), {{"gravity", "paired"}});
  ASSERT_TRUE(estimate.Find("gravity_offset")) << estimate.message;
  // from all samples: within our interval
  EXPECT_TRUE(test::Holds(estimate, "gravity_offset", -3.1648));
  EXPECT_LT((*estimate.Find("gravity_offset")->interval95)[1], 0);
}

}  // namespace
}  // namespace warmjoint
