#include <gmock/gmock.h>
#include <warmjoint/friction.h>
#include <warmjoint/prepared_log.h>

#include "identification/preparation/select.h"
#include "models/recording/read_recording.h"
#include "tests/support/emps_log.h"
#include "tests/support/shared_data.h"
#include "tests/support/warm_recording.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

/// Constant speeds in turn, 20 s each, one sample a second.
Measurements Log(const std::vector<double>& speeds, int repetitions) {
  Measurements log;
  const auto n = static_cast<Eigen::Index>(speeds.size()) * repetitions * 20;
  log.source = "log.csv";
  log.time = Eigen::VectorXd::LinSpaced(n, 0, static_cast<double>(n - 1));
  log.velocity.resize(n);
  log.position.resize(n);
  double position = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    log.velocity[i] = speeds[static_cast<std::size_t>(i / 20) % speeds.size()];
    log.position[i] = position += log.velocity[i];
  }
  log.torque = log.velocity;
  return log;
}

Excitation Find(const RecordingCheck& check, const std::string& what) {
  for (const Excitation& excitation : check.excitation) {
    if (excitation.what.find(what) == 0) return excitation;
  }
  ADD_FAILURE() << "no " << what;
  return {};
}

TEST(CheckRecording, CountsSpeedsByDirection) {
  const RecordingCheck check = CheckRecording(Log({0.1, -0.1, 0.5, -0.5, 0, 0.101}, 10));
  EXPECT_EQ(check.motion.segments, 50);
  EXPECT_DOUBLE_EQ(check.motion.constant_share, 5.0 / 6);
  EXPECT_DOUBLE_EQ(check.motion.rest_share, 1.0 / 6);
  ASSERT_EQ(check.motion.levels.size(), 4U);
  EXPECT_DOUBLE_EQ(check.motion.levels[0].velocity, -0.5);
  EXPECT_NEAR(check.motion.levels[2].velocity, 0.1005, 1e-12);
  EXPECT_EQ(check.motion.levels[2].segments, 20);
  EXPECT_EQ(check.motion.levels[2].samples, 400);
}

TEST(CheckRecording, FindsGapsAndJitter) {
  Measurements log = Log({0.5, -0.5}, 10);
  log.time.tail(100).array() += 9;
  log.time[50] += 0.1;
  const RecordingCheck check = CheckRecording(log);
  EXPECT_EQ(check.sampling.gaps, 1);
  EXPECT_DOUBLE_EQ(check.sampling.longest_gap, 10);
  EXPECT_DOUBLE_EQ(check.sampling.step, 1);
  // two steps of 398 are off by a tenth
  EXPECT_NEAR(check.sampling.jitter, 0.1 * std::sqrt(2.0 / 398), 1e-12);
  EXPECT_THAT(CheckToText(check), HasSubstr("1 gap, the longest 10 s"));
}

TEST(CheckRecording, SaysWhatOneSpeedCannotTell) {
  const RecordingCheck check = CheckRecording(Log({0.5, -0.5}, 20));
  EXPECT_TRUE(Find(check, "law coulomb").sufficient);
  EXPECT_FALSE(Find(check, "law viscous_coulomb").sufficient);
  EXPECT_THAT(Find(check, "law viscous_coulomb").reason, HasSubstr("record a second speed"));
  EXPECT_FALSE(Find(check, "law asymmetric").sufficient);
  EXPECT_FALSE(Find(check, "warm-up").sufficient);
}

TEST(CheckRecording, NeedsBothDirectionsForTheAsymmetricLaw) {
  const RecordingCheck check = CheckRecording(Log({0.1, 0.5}, 20));
  EXPECT_TRUE(Find(check, "law viscous_coulomb").sufficient);
  EXPECT_THAT(Find(check, "law asymmetric").reason, HasSubstr("positive direction; record both"));

  // two speeds, but each direction has one of them: rank 2
  EXPECT_FALSE(Find(CheckRecording(Log({0.1, -0.5}, 20)), "law asymmetric").sufficient);
  EXPECT_TRUE(Find(CheckRecording(Log({0.1, -0.5, 0.5}, 20)), "law asymmetric").sufficient);
}

TEST(CheckRecording, NeedsMinutesForWarmUp) {
  EXPECT_TRUE(Find(CheckRecording(Log({0.1, -0.5}, 10)), "warm-up").sufficient);
  EXPECT_THAT(Find(CheckRecording(Log({0.1, -0.5}, 4)), "warm-up").reason,
              HasSubstr("the log lasts 159 s"));
}

TEST(CheckRecording, NeedsTheGearForMotorRipple) {
  Measurements log = Log({0.01, -0.02, 0.02}, 20);
  EXPECT_THAT(Find(CheckRecording(log), "motor ripple").reason, HasSubstr("--gear"));
  log.gear = 50;
  EXPECT_TRUE(Find(CheckRecording(log), "motor ripple").sufficient);
  log.gear = 500;
  EXPECT_FALSE(Find(CheckRecording(log), "motor ripple").sufficient) << "0.6 samples a turn";
}

TEST(CheckRecording, KnowsStribecksNeeds) {
  const std::vector<double> many{0.01, -0.02, 0.05, -0.1, 0.2, 0.5, -0.5, 0.02, 0.1};
  EXPECT_TRUE(Find(CheckRecording(Log(many, 10)), "law stribeck").sufficient);
  EXPECT_FALSE(Find(CheckRecording(Log({0.1, -0.5}, 10)), "law stribeck").sufficient);
}

TEST(CheckRecording, JudgesAMotionWithoutConstantSpeeds) {
  Measurements log = Log({0.5}, 50);
  log.velocity = (0.01 * log.time.array()).sin();
  log.position = 100 * (1 - (0.01 * log.time.array()).cos());
  const RecordingCheck check = CheckRecording(log);
  EXPECT_EQ(check.motion.segments, 0);
  EXPECT_FALSE(check.motion.holds_speeds);
  // all but a curve over held speeds: fits take motion of any kind
  for (const char* kind : {"law coulomb", "law viscous_coulomb", "law asymmetric", "warm-up"}) {
    EXPECT_TRUE(Find(check, kind).sufficient) << kind;
  }
  EXPECT_FALSE(Find(check, "law stribeck").sufficient);
  EXPECT_THAT(CheckToText(check), HasSubstr("motion of any kind"));

  // a joint that hardly moves shows nothing of any
  log.velocity.head(log.size() - 10).setZero();
  log.position.setZero();
  for (const Excitation& one : CheckRecording(log).excitation) EXPECT_FALSE(one.sufficient);
}

class Emps : public testing::Test {
 protected:
  void SetUp() override {
    WARMJOINT_NEED_SHARED(test::kEmpsFile);
    log_ = Prepare(test::EmpsLog()).raw().measurements;
  }

  Measurements log_;
};

TEST_F(Emps, MovesAtThreeSpeedsInBothDirections) {
  const RecordingCheck check = CheckRecording(log_);
  EXPECT_EQ(check.motion.segments, 32);
  EXPECT_NEAR(check.motion.constant_share, 0.67, 0.01);
  ASSERT_EQ(check.motion.levels.size(), 6U);
  const double speeds[] = {-0.125, -0.083, -0.042, 0.042, 0.083, 0.125};  // m/s
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(check.motion.levels[i].velocity, speeds[i], 0.0005);
  }
  EXPECT_NEAR(check.sampling.rate, 1000, 0.01);
  EXPECT_EQ(check.sampling.gaps, 0);
}

TEST_F(Emps, IsTooShortForWarmUp) {
  const RecordingCheck check = CheckRecording(log_);
  for (const Excitation& excitation : check.excitation) {
    const bool is_law =
        excitation.what == "law coulomb" || excitation.what == "law viscous_coulomb" ||
        excitation.what == "law asymmetric" || excitation.what == "position dependence";
    EXPECT_EQ(excitation.sufficient, is_law) << excitation.what << ": " << excitation.reason;
  }
  EXPECT_THAT(CheckToText(check), testing::HasSubstr("the log lasts 24.8 s"));
}

}  // namespace
}  // namespace warmjoint
