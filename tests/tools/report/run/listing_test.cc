#include "tools/report/run/listing.h"

#include <gtest/gtest.h>

#include <cmath>

namespace warmjoint::report {
namespace {

Result Answered(int realization, const std::string& status) {
  Result result;
  result.realization = realization;
  result.status = status;
  if (status == "ok") {
    result.metrics = Metrics{};
    result.metrics->rmse = realization;
  }
  return result;
}

TEST(Listing, HoldsEveryAnswerOfAShortRun) {
  ListingBuilder builder(3);
  for (int i = 0; i < 3; ++i) builder.Add(Answered(i, i == 1 ? "crashed" : "ok"));
  const Listing listing = std::move(builder).Finish();
  ASSERT_EQ(listing.answers.size(), 3u);
  EXPECT_EQ(listing.every, 1);
  EXPECT_EQ(listing.answers[2].rmse, 2);
  EXPECT_TRUE(std::isnan(listing.answers[1].rmse));
  EXPECT_EQ(listing.answers[1].status, "crashed");
}

TEST(Listing, HoldsOneInSeveralOfALongRunAndItsFirstFailures) {
  // 10^5 answers, every 40th a failure, on average: 51 is no prime, 53 is
  ListingBuilder builder(100'001);
  for (int i = 0; i < 100'001; ++i) builder.Add(Answered(i, i % 40 == 7 ? "crashed" : "ok"));
  const Listing listing = std::move(builder).Finish();
  EXPECT_EQ(listing.every, 53);
  int failed = 0;
  for (const ListedAnswer& answer : listing.answers) {
    failed += answer.status != "ok";
    EXPECT_TRUE(answer.status != "ok" || answer.unit.realization % 53 == 0);
  }
  EXPECT_GE(failed, 500);
  EXPECT_LE(listing.answers.size(), 2500u);
}

}  // namespace
}  // namespace warmjoint::report
