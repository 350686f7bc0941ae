#include "identification/alternating/first_guess.h"

#include <gmock/gmock.h>

#include "identification/preparation/select.h"
#include "tests/support/warm_recording.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

FirstGuess Guess(const Measurements& m) { return GuessThermal(m, SelectMoving(m)); }

TEST(FirstGuess, CorrectsTheFeedbackAtAConstantSpeed) {
  // warming takes tau / (1 + 3 * 0.5) = 240 s to reach 63 %, not 600 s
  const Eigen::VectorXd velocity = Eigen::VectorXd::Constant(3600, 0.5);
  const FirstGuess guess = Guess(test::RecordFriction(test::TableOne(), 1, velocity, 0, 1));
  ASSERT_TRUE(guess.thermal) << guess.why;
  // windows of 90 s: a line through the first two is off by 3/8 (90/240)^2 = 5 % of the change
  EXPECT_NEAR(guess.thermal->gain, -3, 3 * 0.05);
  EXPECT_NEAR(guess.thermal->time_constant, 600, 600 * 0.05);
}

TEST(FirstGuess, ComesWithinAFactorOfTwoOfTableOne) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Eigen::VectorXd velocity = test::AlternatingSpeeds(3600, seed);
    const FirstGuess guess = Guess(test::RecordFriction(test::TableOne(), 1, velocity, 0.5, seed));
    ASSERT_TRUE(guess.thermal) << seed << ": " << guess.why;
    // each window of 90 s holds only 4 or 5 speeds, which spread its losses by a quarter
    EXPECT_NEAR(guess.thermal->gain, -3, 1) << seed;
    EXPECT_GT(guess.thermal->time_constant, 300) << seed;
    EXPECT_LT(guess.thermal->time_constant, 1200) << seed;
  }
}

TEST(FirstGuess, IsRefusedWhereTheRecordNeverSettles) {
  const Eigen::VectorXd velocity = Eigen::VectorXd::Constant(200, 0.5);
  const FirstGuess guess = Guess(test::RecordFriction(test::TableOne(), 1, velocity, 0, 1));
  EXPECT_FALSE(guess.thermal);
  EXPECT_THAT(guess.why, HasSubstr("never settles"));
}

TEST(FirstGuess, IsRefusedWhereNothingWarms) {
  Friction friction = test::TableOne();
  friction.thermal.reset();
  const Eigen::VectorXd velocity = test::AlternatingSpeeds(3600, 3);
  const FirstGuess guess = Guess(test::RecordFriction(friction, 1, velocity, 0.5, 3));
  EXPECT_FALSE(guess.thermal);
  EXPECT_THAT(guess.why, HasSubstr("within its noise"));
}

TEST(FirstGuess, IsRefusedWhereTheJointRestsSoon) {
  const Eigen::VectorXd velocity = test::AlternatingSpeeds(3600, 4, 600);
  const FirstGuess guess = Guess(test::RecordFriction(test::TableOne(), 1, velocity, 0.5, 4));
  EXPECT_FALSE(guess.thermal);
  EXPECT_THAT(guess.why, HasSubstr("too briefly"));
}

}  // namespace
}  // namespace warmjoint
