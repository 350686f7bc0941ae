#include "identification/answer/judge_estimate.h"

#include <gmock/gmock.h>
#include <warmjoint/prepared_log.h>

#include "tests/support/judging.h"

namespace warmjoint {
namespace {

/// An estimate of another program: a friction, and a coulomb with an interval.
Estimate From(const Friction& friction, double half_width) {
  Estimate estimate;
  estimate.identifier = "other";
  estimate.friction = friction;
  const double coulomb = friction.parameters.at("coulomb");
  estimate.parameters = {
      {"viscous", friction.parameters.at("viscous"), "N.m.s/rad", {}, {}},
      {"coulomb", coulomb, "N.m", half_width / 2, {{coulomb - half_width, coulomb + half_width}}}};
  return estimate;
}

TEST(JudgeEstimate, FindsWhatAnotherProgramLeftOut) {
  // no warming on a log that warms
  Estimate estimate = From(test::Cold(), 0.1);
  JudgeEstimate(Prepare(test::RecordHour(test::TableOne(), 1)), {}, estimate);
  EXPECT_EQ(estimate.status, Status::inadequate_model);
  EXPECT_FALSE(estimate.friction);
  EXPECT_FALSE(estimate.Find("coulomb")->interval95);
  EXPECT_EQ(estimate.Find("coulomb")->value, 15);
}

TEST(JudgeEstimate, LetsTheTruthPass) {
  Estimate estimate = From(test::Cold(), 0.1);
  JudgeEstimate(Prepare(test::RecordHour(test::Cold(), 1)), {}, estimate);
  EXPECT_EQ(estimate.status, Status::ok) << estimate.message;
  EXPECT_TRUE(estimate.friction);
  EXPECT_TRUE(test::Asked(estimate, "direction").made);
}

TEST(JudgeEstimate, FindsNumbersThatTheSameLawWouldBetter) {
  // 12 for 15 N.m: the residual is 3 sign v, which the law itself can follow
  Friction low = test::Cold();
  low.parameters["coulomb"] = 12;
  Estimate estimate = From(low, 0.1);
  JudgeEstimate(Prepare(test::RecordHour(test::Cold(), 1)), {}, estimate);
  EXPECT_EQ(estimate.status, Status::inadequate_model);
  EXPECT_FALSE(estimate.friction);

  // one per cent is below what matters
  Friction close = test::Cold();
  close.parameters["coulomb"] = 15.1;
  Estimate passes = From(close, 0.1);
  JudgeEstimate(Prepare(test::RecordHour(test::Cold(), 1)), {}, passes);
  EXPECT_EQ(passes.status, Status::ok) << passes.message;
}

TEST(JudgeEstimate, SaysWhyNothingWasExamined) {
  Estimate estimate = From(test::Cold(), 0.1);
  estimate.friction.reset();
  JudgeEstimate(Prepare(test::RecordHour(test::Cold(), 1)), {}, estimate);
  EXPECT_EQ(estimate.status, Status::ok);
  ASSERT_FALSE(estimate.diagnostics.empty());
  for (const Diagnostic& one : estimate.diagnostics) {
    EXPECT_FALSE(one.made);
    EXPECT_EQ(one.reason, "the fit gives no friction");
  }
}

}  // namespace
}  // namespace warmjoint
