#include "identification/report/end_state.h"

#include <cmath>
#include <map>
#include <string>

#include "models/recording/course_of.h"
#include "tests/support/judging.h"
#include "tests/support/travelling.h"
#include "tests/support/without_times.h"

namespace warmjoint {
namespace {

/// E at the end of a log as its estimate has it.
EstimatedParameter EndOf(const Measurements& m, const std::map<std::string, std::string>& given) {
  const Estimate estimate = test::Fitted("energy-ml", m, given);
  EXPECT_EQ(estimate.status, Status::ok) << estimate.message;
  for (const EstimatedParameter& one : estimate.state_end) {
    if (one.name == "energy") return one;
  }
  ADD_FAILURE() << "no heat at the end";
  return {};
}

FrictionDescription Rippling() {
  FrictionDescription friction = test::TableOne();
  friction.maps = {test::PositionLevel(3, 1.5)};
  return friction;
}

Measurements Log(const FrictionDescription& friction, std::uint64_t seed) {
  return test::RecordFriction(friction, 1, test::Travel(3600, 1, 3, {0.15, 0.3, 0.6}), 0.5, seed);
}

TEST(EndState, OfAMapHasTheIntervalOfLawAndMapTogether) {
  // the law's level alone is not known, its sum with the map is: standardised errors of 20 logs have mean
  // square 1 +- 0.32
  double squares = 0;
  const int logs = 20;
  for (std::uint64_t seed = 1; seed <= logs; ++seed) {
    const Measurements m = Log(Rippling(), seed);
    const double truth = PredictFriction(Rippling(), m).energy[m.size() - 1];
    const EstimatedParameter end =
        EndOf(m, {{"position", "map"}, {"kernels", "20"}, {"bands", "none"}});
    ASSERT_TRUE(end.std && end.interval95);
    EXPECT_LT(*end.std, 0.1 * std::abs(truth));
    squares += std::pow((end.value - truth) / *end.std, 2);
  }
  EXPECT_NEAR(squares / logs, 1, 4 * 0.32);
}

TEST(EndState, IsLessSureBehindAGap) {
  const Measurements all = Log(test::TableOne(), 1);
  const Measurements cut = test::Without(all, {{3000, 3580}});
  const double truth = PredictFriction(test::TableOne(), all).energy[all.size() - 1];
  const EstimatedParameter sure = EndOf(all, {}), unsure = EndOf(cut, {});
  ASSERT_TRUE(sure.std && unsure.std);
  EXPECT_GT(*unsure.std, 2 * *sure.std);
  EXPECT_NEAR(unsure.value, truth, 4 * *unsure.std);
}

}  // namespace
}  // namespace warmjoint
