#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "tests/tools/cli/recording_file.h"
#include "tests/tools/cli/run_program.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

/// Four speeds in both directions, 30 s each.
double SeveralSpeeds(int i) { return (i / 30 % 2 ? -1 : 1) * 0.2 * (1 + i / 60 % 4); }

/// Other ones.
double OtherSpeeds(int i) { return (i / 20 % 2 ? -1 : 1) * 0.15 * (1 + i / 40 % 3); }

class PredictTest : public testing::Test {
 protected:
  void SetUp() override {
    WriteRecordingFile(scratch_.path() / "log.csv", 480, SeveralSpeeds);
    WriteRecordingFile(scratch_.path() / "other.csv", 240, OtherSpeeds);
    const ProgramAnswer answer =
        Run({"identify", "log.csv", "--identifier", "nominal-ls", "-o", "e.json"});
    ASSERT_EQ(answer.status, 0) << answer.err;
  }

  ProgramAnswer Run(std::vector<std::string> arguments) const {
    return RunWarmjoint(std::move(arguments), Surroundings{scratch_.path(), {}});
  }

  const ScratchDirectory scratch_;
};

TEST_F(PredictTest, TellsHowWellAStoredEstimateFitsAnotherRecording) {
  const ProgramAnswer answer = Run({"predict", "e.json", "other.csv", "--format", "json"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  const auto told = nlohmann::json::parse(answer.out);
  EXPECT_EQ(told.at("metrics").at("n"), 240);
  // the ripple that stands in for noise is below 0.2 N.m
  EXPECT_LT(told.at("metrics").at("rmse").get<double>(), 0.2);
  EXPECT_GT(told.at("metrics").at("fit").get<double>(), 98);
}

TEST_F(PredictTest, WritesPredictionsAndResiduals) {
  const ProgramAnswer answer = Run({"predict", "e.json", "other.csv", "-o", "p.csv"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(answer.out, HasSubstr("RMSE N.m"));
  const std::string csv = ReadWholeFile(scratch_.path() / "p.csv");
  EXPECT_THAT(csv, HasSubstr("time,position,velocity,torque,predicted,residual,energy,compared\n"));
  EXPECT_GE(std::count(csv.begin(), csv.end(), '\n'), 241);
}

TEST_F(PredictTest, RefusesAnEstimateWithoutFriction) {
  auto json = nlohmann::json::parse(ReadWholeFile(scratch_.path() / "e.json"));
  json["friction"] = nullptr;
  json["status"] = "inadequate_model";
  WriteWholeFile(scratch_.path() / "void.json", json.dump());
  const ProgramAnswer answer = Run({"predict", "void.json", "other.csv"});
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.err, HasSubstr("is inadequate_model and holds no friction"));
}

TEST_F(PredictTest, TorqueConstantMakesTorqueOfACurrent) {
  const std::vector<std::string> amperes{"identify", "log.csv",  "--identifier",      "nominal-ls",
                                         "--unit",   "torque=A", "--torque-constant", "2",
                                         "--format", "json"};
  const ProgramAnswer answer = Run(amperes);
  ASSERT_EQ(answer.status, 0) << answer.err;
  const auto estimate = nlohmann::json::parse(answer.out);
  const auto before = nlohmann::json::parse(ReadWholeFile(scratch_.path() / "e.json"));
  const auto coulomb = [](const nlohmann::json& one) {
    return one.at("parameters").at("coulomb").at("value").get<double>();
  };
  EXPECT_NEAR(coulomb(estimate), 2 * coulomb(before), 1e-9);
  EXPECT_EQ(estimate.at("parameters").at("coulomb").at("unit"), "N.m");
  EXPECT_FALSE(estimate.at("friction").is_null());

  // a torque is no current
  const ProgramAnswer refused = Run({"identify", "log.csv", "--torque-constant", "2"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("give --unit torque=A"));
}

}  // namespace
}  // namespace warmjoint
