// Predictions by a stored estimate, and recordings that follow one another.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "tests/support/warm_recording.h"
#include "tests/tools/cli/in_a_folder.h"
#include "tests/tools/cli/little_files.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

class PredictTest : public InAFolder {
 protected:
  void SetUp() override {
    WriteRecordingFile(at("log.csv"), 480);
    // at other speeds
    WriteRecordingFile(at("other.csv"), 240,
                       [](int i) { return (i / 20 % 2 ? -1 : 1) * 0.15 * (1 + i / 40 % 3); });
    Call({"identify", "log.csv", "--identifier", "nominal-ls", "-o", "e.json"});
  }
};

TEST_F(PredictTest, TellsHowWellAStoredEstimateFitsAnotherRecording) {
  const auto told = Json({"predict", "e.json", "other.csv"});
  EXPECT_EQ(told.at("metrics").at("n"), 240);
  // the ripple that stands in for noise is below 0.2 N.m
  EXPECT_LT(told.at("metrics").at("rmse").get<double>(), 0.2);
  EXPECT_GT(told.at("metrics").at("fit").get<double>(), 98);

  // as text, with the predictions and residuals in a file
  EXPECT_THAT(Call({"predict", "e.json", "other.csv", "-o", "p.csv"}).out, HasSubstr("RMSE N.m"));
  const std::string csv = File("p.csv");
  EXPECT_THAT(csv, HasSubstr("time,position,velocity,torque,predicted,residual,energy,compared\n"));
  EXPECT_GE(std::count(csv.begin(), csv.end(), '\n'), 241);
}

TEST_F(PredictTest, RefusesAnEstimateWithoutFriction) {
  auto json = JsonFile("e.json");
  json["friction"] = nullptr;
  json["status"] = "inadequate_model";
  WriteWholeFile(at("void.json"), json.dump());
  EXPECT_THAT(Refusal({"predict", "void.json", "other.csv"}),
              HasSubstr("is inadequate_model and holds no friction"));
}

TEST_F(PredictTest, TorqueConstantMakesTorqueOfACurrent) {
  const auto estimate = Json({"identify", "log.csv", "--identifier", "nominal-ls", "--unit",
                              "torque=A", "--torque-constant", "2"});
  const auto before = JsonFile("e.json");
  const auto coulomb = [](const nlohmann::json& one) {
    return one.at("parameters").at("coulomb").at("value").get<double>();
  };
  EXPECT_NEAR(coulomb(estimate), 2 * coulomb(before), 1e-9);
  EXPECT_EQ(estimate.at("parameters").at("coulomb").at("unit"), "N.m");
  EXPECT_FALSE(estimate.at("friction").is_null());

  // a torque is no current
  EXPECT_THAT(Refusal({"identify", "log.csv", "--torque-constant", "2"}),
              HasSubstr("give --unit torque=A"));
}

constexpr int kFirst = 3600, kPause = 300, kSecond = 3600;  // s, a sample each

/// The rows of a recording from one sample to another, its clock set back by `clock` s.
void WriteRows(const std::filesystem::path& path, const Measurements& m, Eigen::Index begin,
               Eigen::Index end, double clock) {
  std::string csv = "time,position,velocity,torque\n";
  for (Eigen::Index i = begin; i < end; ++i) {
    csv +=
        fmt::format("{},{},{},{}\n", m.time[i] - clock, m.position[i], m.velocity[i], m.torque[i]);
  }
  WriteWholeFile(path, csv);
}

/// A run of the joint of Table I, cut in two with a pause of 300 s between: day1.csv, day2.csv that
/// begins at 0 s, and later.csv, the same by the clock of day1.
class FollowTest : public InAFolder {
 protected:
  void SetUp() override {
    Eigen::VectorXd velocity = test::AlternatingSpeeds(kFirst + kPause + kSecond, 7);
    velocity.segment(kFirst, kPause).setZero();
    const Measurements m = test::RecordFriction(test::TableOne(), 1, velocity, 0.3, 7);
    const Eigen::Index second = kFirst + kPause;
    WriteRows(at("day1.csv"), m, 0, kFirst, 0);
    WriteRows(at("day2.csv"), m, second, m.size(), m.time[second]);
    WriteRows(at("later.csv"), m, second, m.size(), 0);
    Call({"identify", "day1.csv", "-o", "day1.json"});
  }
};

/// By how many deviations a parameter lies off, and its interval.
double Off(const nlohmann::json& estimate, const char* name, double truth) {
  const auto& one = estimate.at("parameters").at(name);
  return (one.at("value").get<double>() - truth) / one.at("std").get<double>();
}

TEST_F(FollowTest, TheSecondRecordingFindsTheTruthThatAColdStartMisses) {
  const auto followed = Json({"identify", "day2.csv", "--follows", "day1.json", "--pause", "300"});
  ASSERT_EQ(followed.at("status"), "ok") << followed.at("message");
  for (const auto& [name, truth] : {std::pair{"viscous", 5.0},
                                    {"coulomb", 15.0},
                                    {"thermal_gain", -3.0},
                                    {"thermal_time_constant", 600.0}}) {
    EXPECT_LT(std::abs(Off(followed, name, truth)), 3) << name;
  }
  const auto& expected = followed.at("follows").at("energy");
  const auto& fitted = followed.at("parameters").at("initial_energy");
  EXPECT_NEAR(fitted.at("value").get<double>(), expected.at("value").get<double>(),
              3 * expected.at("std").get<double>());
  // what is known beforehand is not forgotten
  EXPECT_LE(fitted.at("std").get<double>(), 1.01 * expected.at("std").get<double>());

  // from cold the same log is refused, or its level lies far off
  const auto cold = Json({"identify", "day2.csv"});
  const bool refused = cold.at("status") != "ok";
  EXPECT_TRUE(refused || std::abs(Off(cold, "coulomb", 15)) > 5);

  // and E(0) from the second log alone is known less well
  const auto alone = Json({"identify", "day2.csv", "--start", "estimated"});
  EXPECT_GT(alone.at("parameters").at("coulomb").at("std").get<double>(),
            1.2 * followed.at("parameters").at("coulomb").at("std").get<double>());
}

TEST_F(FollowTest, TakesTheEarlierRecordingItselfAndTheStampsOfOneClock) {
  const auto given = Json({"identify", "day2.csv", "--follows", "day1.json", "--pause", "300"});
  const auto stamps = Json({"identify", "later.csv", "--follows", "day1.csv"});
  EXPECT_EQ(given.at("follows").at("pause_from"), "given");
  EXPECT_EQ(stamps.at("follows").at("pause_from"), "stamps");
  // from the last sample to the first one
  EXPECT_NEAR(stamps.at("follows").at("pause").get<double>(), kPause + 1, 1e-9);
  const double at_300 = given.at("follows").at("energy").at("value");
  const double at_301 = stamps.at("follows").at("energy").at("value");
  EXPECT_NEAR(at_301 / at_300, std::exp(-1.0 / 600), 1e-3);
}

TEST_F(FollowTest, TellsWhereTheLogContradictsThePause) {
  const auto estimate = Json({"identify", "day2.csv", "--follows", "day1.json", "--pause", "3"});
  ASSERT_EQ(estimate.at("status"), "ok") << estimate.at("message");
  EXPECT_THAT(estimate.at("message").get<std::string>(), HasSubstr("check the pause"));
  EXPECT_LT(std::abs(Off(estimate, "coulomb", 15)), 3);
}

TEST_F(FollowTest, PredictsWithTheHeatThatWasLeft) {
  const auto rmse = [](const nlohmann::json& told) {
    return told.at("metrics").at("rmse").get<double>();
  };
  const auto cold = Json({"predict", "day1.json", "day2.csv"});
  for (const char* file : {"day1.json", "day1.csv"}) {
    const auto followed =
        Json({"predict", "day1.json", "day2.csv", "--follows", file, "--pause", "301"});
    // noise of 0.3 N.m, and what the parameters are off
    EXPECT_NEAR(rmse(followed), 0.3, 0.02) << file;
    EXPECT_LT(rmse(followed), 0.5 * rmse(cold)) << file;
    EXPECT_EQ(followed.at("follows").at("pause"), 301) << file;
  }
}

TEST_F(FollowTest, RefusesWhatCannotFollow) {
  const std::vector<std::string> follows{"identify", "day2.csv", "--follows", "day1.json"};
  const std::vector<std::string> paused = With(follows, {"--pause", "300"});
  EXPECT_THAT(Refusal(follows), HasSubstr("share no clock: give --pause SECONDS"));
  EXPECT_THAT(Refusal({"identify", "day2.csv", "--pause", "300"}),
              HasSubstr("name that with --follows"));
  EXPECT_THAT(Refusal(With(follows, {"--pause", "-1"})), HasSubstr("0 or more"));
  EXPECT_THAT(Refusal(With(paused, {"--identifier", "nominal-ls"})),
              HasSubstr("nominal-ls cannot estimate the heat at the start; use one of: energy-ml"));
  EXPECT_THAT(Refusal(With(paused, {"--start", "estimated"})), HasSubstr("leave one of them"));
  EXPECT_THAT(Refusal({"identify", "day1.csv", "day2.csv", "--follows", "day1.json"}),
              HasSubstr("is for one recording"));
  EXPECT_THAT(Refusal({"predict", "day1.json", "day2.csv", "--follows", "day1.json", "--initial",
                       "end", "--pause", "3"}),
              HasSubstr("leave one"));

  // what knows no heat leaves none
  ASSERT_EQ(Program({"identify", "day1.csv", "--identifier", "energy-ml", "--set", "law=coulomb",
                     "-o", "bad.json"})
                .status,
            3);
  EXPECT_THAT(Refusal({"identify", "day2.csv", "--follows", "bad.json", "--pause", "300"}),
              HasSubstr("tells of no heat at its end"));
}

}  // namespace
}  // namespace warmjoint
