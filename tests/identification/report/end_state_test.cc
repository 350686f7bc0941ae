#include "identification/report/end_state.h"

#include <gmock/gmock.h>
#include <warmjoint/prepared_log.h>

#include <cmath>
#include <map>
#include <string>

#include "identification/answer/identify.h"
#include "identification/identifiers/identifier_list.h"
#include "models/recording/course_of.h"
#include "tests/support/travelling.h"
#include "tests/support/without_times.h"

namespace warmjoint {
namespace {

/// E at the end of a log as its estimate has it.
EstimatedParameter EndOf(const Measurements& m, const std::map<std::string, std::string>& given) {
  const Identifier& identifier = FindIdentifier("energy-ml");
  const Estimate estimate =
      IdentifyUnjudged(identifier, {Prepare(m), identifier.options.Read(given), {}});
  EXPECT_EQ(estimate.status, Status::ok) << estimate.message;
  for (const EstimatedParameter& one : estimate.state_end) {
    if (one.name == "energy") return one;
  }
  ADD_FAILURE() << "no heat at the end";
  return {};
}

Friction Rippling() {
  Friction friction = test::TableOne();
  friction.maps = {test::PositionLevel(3, 1.5)};
  return friction;
}

Measurements Log(const Friction& friction, std::uint64_t seed) {
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

TEST(EndState, IsTheSameByTheFitsRecursionAsAlongTheMotion) {
  // E(0) and, behind a gap, a jump are estimated too
  const Measurements m = test::Without(Log(test::TableOne(), 1), {{2000, 2400}});
  const Identifier& identifier = FindIdentifier("energy-ml");
  Fit fit =
      identifier.fit({Prepare(m), identifier.options.Read({{"initial_energy", "estimated"}}), {}});
  ASSERT_FALSE(fit.refusal);
  ASSERT_TRUE(fit.end_energy);
  const Inference inference = Infer(fit);
  const auto by_fit = EndState(fit, inference, fit.friction, m);
  fit.end_energy = nullptr;
  const auto by_differences = EndState(fit, inference, fit.friction, m);

  // 1e-2: differences of one standard error bend by its square
  ASSERT_EQ(by_fit.size(), by_differences.size());
  ASSERT_TRUE(by_fit.back().std && by_differences.back().std);
  EXPECT_NEAR(*by_fit.back().std, *by_differences.back().std, 1e-2 * *by_fit.back().std);
  // 1e-12: two recursions over 3200 steps, each of which rounds by 1e-16
  EXPECT_NEAR(by_fit.back().value, by_differences.back().value,
              1e-12 * std::abs(by_fit.back().value));
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
