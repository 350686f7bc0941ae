#include "identification/warming/warming_verdict.h"

#include <gmock/gmock.h>

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

/// 1200 s that show the warming clearly.
WarmingEvidence Twenty(double time_constant, double log_deviation) {
  return {1000, log_deviation, time_constant, 2.4, 6000, 1200};
}

TEST(WarmingVerdict, AsksMoreWhereTheIntervalReachesBeyondTheRecording) {
  EXPECT_FALSE(UnidentifiableWarming(Twenty(300, 0.4)));
  EXPECT_FALSE(UnidentifiableWarming(Twenty(3600, 0.2)));
  // an endless tau is 3.3 deviations away, and many more joints are slow than short by chance
  EXPECT_THAT(*UnidentifiableWarming(Twenty(3600, 0.3)),
              HasSubstr("tau is known to a factor of 1.8"));
  EXPECT_THAT(*UnidentifiableWarming(Twenty(300, 0.6)),
              HasSubstr("tau is known to a factor of 3.24"));
}

TEST(WarmingVerdict, SaysThatTheTimeConstantRanAway) {
  EXPECT_THAT(*UnidentifiableWarming(Twenty(1e5, 3)), HasSubstr("any longer tau fits as well"));
  EXPECT_THAT(*RunawayWarming(1e9, 1200), HasSubstr("at the end of the 1200 s"));
  EXPECT_FALSE(RunawayWarming(5999, 1200));
}

TEST(WarmingVerdict, NamesWhatIsWrongWithTheTimeConstant) {
  // a factor of 2 % would be good: what is wrong is that the log cannot show so short a tau
  const std::string beyond = *UnidentifiableWarming(Twenty(0.2, 0.01));
  EXPECT_THAT(beyond, HasSubstr("tau is 0.2 s, and the log can show 2.4 to 6e+03 s"));
  EXPECT_THAT(beyond, testing::Not(HasSubstr("factor")));
  for (const double unknown : {5.0, 1e6, std::numeric_limits<double>::infinity()}) {
    const std::string words = *UnidentifiableWarming(Twenty(300, unknown));
    EXPECT_THAT(words, HasSubstr("nothing is known of tau"));
    EXPECT_THAT(words, testing::Not(HasSubstr("inf")));
  }
}

TEST(WarmingVerdict, SaysThatNoWarmingCanBeSeen) {
  EXPECT_THAT(*UnidentifiableWarming({19, 0.1, 300, 2.4, 6000, 1200}),
              HasSubstr("no warm-up can be seen"));
}

}  // namespace
}  // namespace warmjoint
