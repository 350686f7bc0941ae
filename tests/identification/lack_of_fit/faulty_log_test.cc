// What becomes of answers to logs that contradict themselves.
#include <gmock/gmock.h>
#include <warmjoint/prepared_log.h>

#include <numbers>

#include "identification/answer/identify.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/preparation/select.h"
#include "tests/support/judging.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

/// An hour whose velocity is in revolutions a minute.
Measurements HourInRpm() {
  Measurements m = test::RecordHour(test::TableOne(), 1);
  m.velocity *= 60 / (2 * std::numbers::pi);
  return m;
}

TEST(FaultyLog, EndsAsBadDataForEveryIdentifier) {
  const Measurements m = HourInRpm();
  const Selection selection = SelectConstantSpeed(m);
  for (const char* name : {"energy-ml", "nominal-ls", "lugre", "kalman"}) {
    const Identifier& identifier = FindIdentifier(name);
    const Estimate estimate =
        IdentifyAndJudge(identifier, {Prepare(m, selection), identifier.options, {}});
    EXPECT_EQ(estimate.status, Status::bad_data) << name;
    EXPECT_THAT(estimate.message, HasSubstr("--unit velocity=rpm")) << name;
    EXPECT_FALSE(estimate.friction) << name;
    for (const EstimatedParameter& one : estimate.parameters) EXPECT_FALSE(one.interval95) << name;
  }
}

TEST(FaultyLog, ShowsItsNumbersByForce) {
  const Measurements m = HourInRpm();
  const Selection selection = SelectConstantSpeed(m);
  const Identifier& identifier = FindIdentifier("nominal-ls");
  const IdentifierInput input{Prepare(m, selection), identifier.options, {}};
  const Answer answer = FitAndJudge(identifier, input);
  ASSERT_EQ(answer.inferred.status, Status::ok);
  const Estimate shown = WithVoidNumbers(identifier, input, answer);
  EXPECT_EQ(shown.status, Status::bad_data);
  EXPECT_TRUE(shown.Find("viscous")->interval95);
  EXPECT_THAT(shown.message, HasSubstr("all numbers are void"));
}

}  // namespace
}  // namespace warmjoint
