#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/identify.h>
#include <warmjoint/simulate.h>

#include <array>
#include <functional>
#include <nlohmann/json.hpp>
#include <thread>

#include "models/foundation/atomic_file.h"
#include "tests/tools/cli/recording_file.h"
#include "tests/tools/cli/run_program.h"
#include "tests/tools/cli/table_one_yaml.h"
#include "tests/tools/interface/motions.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint::api {
namespace {

using testing::HasSubstr;

/// Writes the estimate beside the command's file, since what is in it is named from its folder.
void ExpectSameFile(const Estimate& estimate, const std::filesystem::path& file) {
  const std::filesystem::path ours = file.parent_path() / "ours.json";
  WriteEstimate(estimate, ours);
  EXPECT_EQ(ReadWholeFile(ours), ReadWholeFile(file));
}

/// One thing asked of both: the arguments behind RECORDING, and the settings that mean the same.
struct Asked {
  std::string name;
  std::vector<std::string> arguments;
  std::function<void(ReadSettings&, PrepareSettings&, IdentifySettings&)> set;
  Status status = Status::ok;
  double (*velocity)(int) = SeveralSpeeds;
};

void PrintTo(const Asked& asked, std::ostream* stream) { *stream << asked.name; }

class IdentifyAsTheCommand : public testing::TestWithParam<Asked> {};

TEST_P(IdentifyAsTheCommand, GivesTheSameFileToTheLastByte) {
  const ScratchDirectory scratch;
  const std::string log = scratch.path() / "log.csv", file = scratch.path() / "estimate.json";
  WriteRecordingFile(log, 480, GetParam().velocity);
  std::vector<std::string> arguments{"identify", log, "-o", file};
  arguments.insert(arguments.end(), GetParam().arguments.begin(), GetParam().arguments.end());
  const ProgramAnswer answer = RunWarmjoint(arguments);
  ASSERT_EQ(answer.status, GetParam().status == Status::ok ? 0 : 3) << answer.err;

  ReadSettings read;
  PrepareSettings prepare;
  IdentifySettings settings;
  GetParam().set(read, prepare, settings);
  const Estimate estimate = Identify(PreparedLog(ReadRecording(log, read), prepare), settings);
  EXPECT_EQ(estimate.status, GetParam().status) << estimate.message;
  ExpectSameFile(estimate, file);

  // and there and back as values
  ExpectSameFile(ReadEstimate(file), file);
}

INSTANTIATE_TEST_SUITE_P(
    Logs, IdentifyAsTheCommand,
    testing::Values(
        Asked{"Defaults, on a log too short to tell warming",
              {},
              [](auto&, auto&, auto&) {},
              Status::not_identifiable},
        Asked{"Refused",
              {"--identifier", "nominal-ls"},
              [](auto&, auto&, auto& settings) { settings.identifier = "nominal-ls"; },
              Status::not_identifiable,
              OneSpeed},
        Asked{"Linear joint in other units",
              {"--identifier", "nominal-ls", "--unit", "position=mm,velocity=mm/s,torque=kN",
               "--joint", "linear", "--gear", "3", "--scale", "torque=0.5"},
              [](auto& read, auto&, auto& settings) {
                settings.identifier = "nominal-ls";
                read.unit = {{"torque", "kN"}, {"position", "mm"}, {"velocity", "mm/s"}};
                read.joint = JointKind::linear;
                read.gear = 3;
                read.scale = {{"torque", 0.5}};
              }},
        Asked{"Options, gravity and trimmed holds",
              {"--identifier", "nominal-ls", "--set", "law=asymmetric", "--gravity", "sincos",
               "--trim", "1", "--shortest-hold", "2", "--start", "unknown", "--relevance", "0.05",
               "--holdout", "0.4"},
              [](auto&, auto& prepare, auto& settings) {
                settings.identifier = "nominal-ls";
                settings.options = {{"law", "asymmetric"}};
                settings.gravity = "sincos";
                settings.start = "unknown";
                settings.relevance = 0.05;
                settings.holdout = 0.4;
                prepare = {1, 2};
              }},
        Asked{"Maps",
              {"--identifier", "position-ridge", "--holdout", "0"},
              [](auto&, auto&, auto& settings) {
                settings.identifier = "position-ridge";
                settings.holdout = 0;
              }},
        Asked{"A current, which MuJoCo does not know",
              {"--identifier", "nominal-ls", "--unit", "torque=A"},
              [](auto& read, auto&, auto& settings) {
                settings.identifier = "nominal-ls";
                read.unit = {{"torque", "A"}};
              }}),
    [](const auto& asked) {
      std::string name = asked.param.name;
      std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
      return name;
    });

TEST(Identify, TellsWarmingAsTheCommand) {
  const ScratchDirectory scratch;
  const std::string log = scratch.path() / "log.csv", file = scratch.path() / "estimate.json";
  WriteRecording(SimulateText(TableOneYaml(3600)).recording, log);
  for (const std::string identifier : {"energy-ml", "energy-als", "kalman"}) {
    const int status =
        RunWarmjoint({"identify", log, "--identifier", identifier, "-o", file}).status;
    IdentifySettings settings;
    settings.identifier = identifier;
    const Estimate estimate = Identify(ReadRecording(log), settings);
    ExpectSameFile(estimate, file);
    EXPECT_EQ(status, estimate.status == Status::ok ? 0 : 3) << estimate.message;
    if (identifier != "energy-ml") continue;
    ASSERT_NE(estimate.Find("thermal_gain"), nullptr) << estimate.message;
    // the truth is -3; its standard error over an hour is some 0.1
    EXPECT_NEAR(estimate.Find("thermal_gain")->value, -3, 0.5);
  }
}

TEST(Identify, JoinsRecordingsAndHoldsOutOnAnotherAsTheCommand) {
  const ScratchDirectory scratch;
  const std::string first = scratch.path() / "monday.csv", second = scratch.path() / "tuesday.csv";
  const std::string file = scratch.path() / "estimate.json";
  WriteRecordingFile(first, 480, SeveralSpeeds);
  WriteRecordingFile(second, 240, SeveralSpeeds);
  ASSERT_EQ(RunWarmjoint({"identify", first, second, "--identifier", "nominal-ls", "--holdout",
                          second, "-o", file})
                .status,
            0);
  IdentifySettings settings;
  settings.identifier = "nominal-ls";
  settings.holdout_log = ReadRecording(second);
  const Estimate estimate = Identify(ReadRecordings({first, second}), settings);
  ExpectSameFile(estimate, file);
  ASSERT_TRUE(estimate.holdout);
  EXPECT_EQ(estimate.holdout->n, 240);
}

TEST(Identify, FollowsAnEarlierRecordingAsTheCommand) {
  const ScratchDirectory scratch;
  const std::string log = scratch.path() / "log.csv", earlier = scratch.path() / "earlier.json";
  const std::string file = scratch.path() / "estimate.json";
  WriteRecording(SimulateText(TableOneYaml(3600)).recording, log);
  RunWarmjoint({"identify", log, "-o", earlier});
  RunWarmjoint({"identify", log, "--follows", earlier, "--pause", "60", "-o", file});
  IdentifySettings settings;
  settings.follows = Identify(ReadRecording(log));
  settings.pause = 60;
  const Estimate estimate = Identify(ReadRecording(log), settings);

  // all that the fit made, and with what it began; the file names the earlier one's
  const Estimate asked = ReadEstimate(file);
  ASSERT_TRUE(asked.follows && estimate.follows);
  EXPECT_EQ(asked.follows->file, earlier);
  EXPECT_EQ(estimate.follows->file, log);
  EXPECT_EQ(estimate.follows->pause, 60);
  EXPECT_EQ(estimate.follows->energy, asked.follows->energy);
  EXPECT_EQ(estimate.follows->std, asked.follows->std);
  EXPECT_EQ(estimate.options, asked.options);
  EXPECT_EQ(estimate.options.count("expected_energy"), 1u);
  ASSERT_EQ(estimate.parameters.size(), asked.parameters.size());
  for (const Parameter& parameter : asked.parameters) {
    ASSERT_NE(estimate.Find(parameter.name), nullptr) << parameter.name;
    EXPECT_EQ(estimate.Find(parameter.name)->value, parameter.value) << parameter.name;
  }
}

TEST(Identify, ShowsVoidNumbersWhereAskedAsTheCommand) {
  const ScratchDirectory scratch;
  const std::string log = scratch.path() / "log.csv", file = scratch.path() / "estimate.json";
  // a level that drifts by a third, of which nominal-ls knows nothing
  WriteRecordingFile(log, 480, SeveralSpeeds, [](int i) { return -0.01 * i; });
  ASSERT_EQ(RunWarmjoint({"identify", log, "--identifier", "nominal-ls", "--relevance", "0.01",
                          "--force", "-o", file})
                .status,
            3);
  IdentifySettings settings;
  settings.identifier = "nominal-ls";
  settings.relevance = 0.01;
  EXPECT_TRUE(Identify(ReadRecording(log), settings).parameters.front().interval95 == std::nullopt);
  settings.void_numbers = VoidNumbers::show;
  const Estimate shown = Identify(ReadRecording(log), settings);
  EXPECT_EQ(shown.status, Status::inadequate_model);
  ExpectSameFile(shown, file);
}

TEST(Identify, RefusesSettingsWithTheBoundOrTheNearestName) {
  const ScratchDirectory scratch;
  const std::string log = scratch.path() / "log.csv";
  WriteRecordingFile(log, 480, SeveralSpeeds);
  const PreparedLog prepared(ReadRecording(log));
  const auto refusal = [&](const std::function<void(IdentifySettings&)>& change) {
    IdentifySettings settings;
    change(settings);
    try {
      Identify(prepared, settings);
    } catch (const BadInput& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(refusal([](auto& s) { s.identifier = "nominal-sl"; }), HasSubstr("'nominal-ls'"));
  EXPECT_THAT(refusal([](auto& s) { s.options = {{"lwa", "coulomb"}}; }), HasSubstr("'law'"));
  EXPECT_THAT(refusal([](auto& s) { s.gravity = "sincs"; }), HasSubstr("'sincos'"));
  EXPECT_THAT(refusal([](auto& s) { s.start = "cool"; }), HasSubstr("'cold'"));
  EXPECT_THAT(refusal([](auto& s) { s.relevance = 2; }), HasSubstr("at most 1"));
  EXPECT_THAT(refusal([](auto& s) { s.holdout = 1; }), HasSubstr("below 1"));
  EXPECT_THAT(refusal([](auto& s) { s.pause = 60; }), HasSubstr("as follows"));
}

TEST(Identify, AnswersTheSameInManyThreads) {
  const PreparedLog log(SimulateText(TableOneYaml(1200)).recording);
  const std::string alone = EstimateToJson(Identify(log));
  std::array<std::string, 4> answers;
  {
    std::vector<std::jthread> threads;
    for (std::string& answer : answers) {
      threads.emplace_back([&] { answer = EstimateToJson(Identify(log)); });
    }
  }
  for (const std::string& answer : answers) EXPECT_EQ(answer, alone);
}

TEST(Identifiers, AreThoseOfTheCommandWithTheirOptions) {
  const auto listed =
      nlohmann::json::parse(RunWarmjoint({"list", "identifiers", "--format", "json"}).out);
  const std::vector<IdentifierInfo> all = Identifiers();
  ASSERT_EQ(all.size(), listed.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(nlohmann::json(all[i].name), listed[i].at("name"));
    EXPECT_EQ(nlohmann::json(all[i].summary), listed[i].at("summary"));
    ASSERT_EQ(all[i].options.size(), listed[i].at("options").size());
    for (std::size_t k = 0; k < all[i].options.size(); ++k) {
      const auto& option = listed[i]["options"][k];
      EXPECT_EQ(nlohmann::json(all[i].options[k].name), option.at("name"));
      EXPECT_EQ(nlohmann::json(all[i].options[k].default_value), option.at("default"));
      EXPECT_EQ(nlohmann::json(all[i].options[k].allowed), option.at("allowed"));
      EXPECT_EQ(nlohmann::json(all[i].options[k].meaning), option.at("meaning"));
    }
  }
}

}  // namespace
}  // namespace warmjoint::api
