#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/friction.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "models/friction/friction_json.h"
#include "tests/support/folders.h"
#include "tests/support/shared_data.h"
#include "tests/tools/cli/recording_file.h"
#include "tests/tools/cli/run_program.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Four speeds in both directions, 30 s each.
double SeveralSpeeds(int i) { return (i / 30 % 2 ? -1 : 1) * 0.2 * (1 + i / 60 % 4); }

TEST(Identify, WritesTheContractsJsonAndAFrictionFile) {
  const ScratchDirectory scratch;
  const std::string recording = scratch.path() / "log.csv";
  WriteRecordingFile(recording, 480, SeveralSpeeds);
  const std::string output = scratch.path() / "estimate.json";
  const ProgramAnswer answer =
      RunWarmjoint({"identify", recording, "--identifier", "nominal-ls", "-o", output});
  ASSERT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(answer.out, HasSubstr("nominal-ls: ok"));
  EXPECT_THAT(answer.out, HasSubstr("held out"));

  const auto estimate = nlohmann::json::parse(ReadWholeFile(output));
  EXPECT_EQ(estimate.at("status"), "ok");
  // the ripple of 0.2 N.m stands in for noise: 0.1 is some five standard deviations of the level
  EXPECT_NEAR(estimate.at("parameters").at("coulomb").at("value").get<double>(), 15, 0.1);
  EXPECT_EQ(estimate.at("parameters").at("coulomb").at("unit"), "N.m");
  EXPECT_EQ(estimate.at("parameters").at("coulomb").at("interval95").size(), 2u);
  EXPECT_EQ(estimate.at("metrics").at("n"), 480);
  EXPECT_LT(estimate.at("holdout").at("n").get<int>(), 480);
  EXPECT_EQ(ReadFriction(output).law, "viscous_coulomb");
}

TEST(Identify, ReadsStandardInput) {
  const ScratchDirectory scratch;
  WriteRecordingFile(scratch.path() / "log.csv", 480, SeveralSpeeds);
  const Surroundings here{scratch.path(), {}};
  const std::string program = test::BuildFolder() / "warmjoint";
  const auto piped = [&](const std::string& command) {
    return RunCommandLine({"sh", "-c", command}, here);
  };
  const std::string rest = " identify - --identifier nominal-ls --format json";
  const ProgramAnswer file =
      RunWarmjoint({"identify", "log.csv", "--identifier", "nominal-ls", "--format", "json"}, here);

  // the same numbers through a pipe, also a slow one, and from a redirected file
  for (const std::string& command :
       {"cat log.csv | " + program + rest, program + rest + " < log.csv",
        "(sleep 4; cat log.csv) | " + program + rest}) {
    const ProgramAnswer answer = piped(command);
    ASSERT_EQ(answer.status, 0) << answer.err;
    EXPECT_EQ(nlohmann::json::parse(answer.out).at("parameters"),
              nlohmann::json::parse(file.out).at("parameters"));
  }

  // standard input is no output, and cannot be read again
  const ProgramAnswer both = piped("cat log.csv | " + program + " identify - -o - | head -c 1");
  EXPECT_EQ(both.out, "{") << both.err;
  ASSERT_EQ(piped("cat log.csv | " + program + rest + " -o estimate.json").status, 0);
  const ProgramAnswer plot = RunWarmjoint({"plot", "estimate.json", "-o", "plots"}, here);
  EXPECT_EQ(plot.status, 2);
  EXPECT_THAT(plot.err, HasSubstr("--recording"));
  EXPECT_THAT(piped(program + " check - < /dev/null").err, HasSubstr("standard input"));
}

TEST(Identify, PrintsTheSameJsonAsItWrites) {
  const ScratchDirectory scratch;
  const std::string recording = scratch.path() / "log.csv";
  WriteRecordingFile(recording, 480, SeveralSpeeds);
  const std::string output = scratch.path() / "estimate.json";
  const std::vector<std::string> command{"identify", recording, "--identifier", "nominal-ls",
                                         "--format", "json",    "-o",           output};
  const ProgramAnswer answer = RunWarmjoint(command);
  ASSERT_EQ(answer.status, 0) << answer.err;
  auto printed = nlohmann::json::parse(answer.out);
  EXPECT_EQ(printed, nlohmann::json::parse(ReadWholeFile(output)));
  EXPECT_EQ(printed.at("recording").at("files"), nlohmann::json({"log.csv"}));

  // once, where both go to standard output, from which no folder of the recording follows
  std::vector<std::string> both = command;
  both.back() = "-";
  auto alone = nlohmann::json::parse(RunWarmjoint(both).out);
  EXPECT_EQ(alone.at("recording").at("files"), nlohmann::json({recording}));
  printed.erase("recording");
  alone.erase("recording");
  EXPECT_EQ(printed, alone);
}

TEST(Identify, ExplainsEveryTestAndAssumptionWhenAsked) {
  const ScratchDirectory scratch;
  const std::string recording = scratch.path() / "log.csv";
  WriteRecordingFile(recording, 480, SeveralSpeeds);
  const std::vector<std::string> command{"identify", recording, "--identifier", "nominal-ls"};
  std::vector<std::string> more = command, json = command;
  more.push_back("--explain");
  json.insert(json.end(), {"--format", "json"});
  const std::string brief = RunWarmjoint(command).out, full = RunWarmjoint(more).out;
  const auto estimate = nlohmann::json::parse(RunWarmjoint(json).out);
  ASSERT_FALSE(estimate.at("diagnostics").empty());
  for (const auto& one : estimate.at("diagnostics")) {
    EXPECT_THAT(full, HasSubstr("\n" + one.at("test").get<std::string>() + " "));
  }
  for (const auto& one : estimate.at("assumptions")) {
    EXPECT_THAT(full, HasSubstr("  " + one.at("name").get<std::string>() + ": "));
  }
  EXPECT_THAT(brief, Not(HasSubstr("test for lack of fit")));
}

TEST(Identify, HoldsNothingOutWhenAsked) {
  const ScratchDirectory scratch;
  const std::string recording = scratch.path() / "log.csv";
  WriteRecordingFile(recording, 480, SeveralSpeeds);
  const std::string output = scratch.path() / "estimate.json";
  const std::vector<std::string> command{"identify", recording, "--identifier", "nominal-ls",
                                         "-o",       output,    "--holdout"};
  std::vector<std::string> none = command;
  none.push_back("0");
  EXPECT_THAT(RunWarmjoint(none).out, Not(HasSubstr("held out")));
  EXPECT_TRUE(nlohmann::json::parse(ReadWholeFile(output)).at("holdout").is_null());

  // another recording of the same joint
  std::vector<std::string> other = command;
  other.push_back(recording);
  EXPECT_EQ(RunWarmjoint(other).status, 0);
  EXPECT_EQ(nlohmann::json::parse(ReadWholeFile(output)).at("holdout").at("n"), 480);
}

TEST(Identify, OneSpeedAloneGivesStatus3AndNoNumbers) {
  const ScratchDirectory scratch;
  const std::string recording = scratch.path() / "log.csv";
  WriteRecordingFile(recording, 400, [](int i) { return i / 20 % 2 ? -0.5 : 0.5; });
  const auto identifiers =
      nlohmann::json::parse(RunWarmjoint({"list", "identifiers", "--format", "json"}).out);
  for (const auto& identifier : identifiers) {
    const std::string name = identifier.at("name");
    if (name == "auto") continue;  // takes a law without slope
    const std::string output = scratch.path() / (name + ".json");
    const ProgramAnswer answer = RunWarmjoint({"identify", recording, "--identifier", name, "-o",
                                               output, "--mjcf", scratch.path() / (name + ".xml")});
    EXPECT_EQ(answer.status, 3) << name;
    EXPECT_THAT(answer.out, HasSubstr("not_identifiable")) << name;
    const auto estimate = nlohmann::json::parse(ReadWholeFile(output));
    EXPECT_EQ(estimate.at("status"), "not_identifiable") << name;
    EXPECT_THAT(estimate.at("message").get<std::string>(), HasSubstr("viscous")) << name;
    EXPECT_TRUE(estimate.at("parameters").empty()) << name;
    EXPECT_TRUE(estimate.at("friction").is_null()) << name;
    EXPECT_FALSE(std::filesystem::exists(scratch.path() / (name + ".xml"))) << name;
  }
}

TEST(Identify, TakesSeveralRecordingsAtOnce) {
  const ScratchDirectory scratch;
  const std::string first = scratch.path() / "monday.csv", second = scratch.path() / "tuesday.csv";
  WriteRecordingFile(first, 480, SeveralSpeeds);
  WriteRecordingFile(second, 240, SeveralSpeeds);
  const std::string output = scratch.path() / "estimate.json";
  const ProgramAnswer answer =
      RunWarmjoint({"identify", first, second, "--identifier", "nominal-ls", "-o", output});
  ASSERT_EQ(answer.status, 0) << answer.err;
  EXPECT_EQ(nlohmann::json::parse(ReadWholeFile(output)).at("metrics").at("n"), 720);

  const ProgramAnswer check = RunWarmjoint({"check", first, second, "--format", "json"});
  ASSERT_EQ(check.status, 0) << check.err;
  EXPECT_EQ(nlohmann::json::parse(check.out).at("recordings").size(), 2u);
  EXPECT_THAT(RunWarmjoint({"check", first, second}).out,
              testing::AllOf(HasSubstr("monday.csv"), HasSubstr("tuesday.csv")));
}

TEST(Identify, TellsGravityFromFrictionOrSaysWhyNot) {
  const ScratchDirectory scratch;
  const std::string recording = scratch.path() / "log.csv";
  WriteRecordingFile(recording, 480, SeveralSpeeds);
  const std::string output = scratch.path() / "estimate.json";
  const auto identify = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"identify", recording, "-o", output});
    return RunWarmjoint(more);
  };
  const ProgramAnswer answer = identify({"--identifier", "nominal-ls", "--gravity", "sincos"});
  EXPECT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(answer.out, HasSubstr("gravity_cosine"));
  const auto estimate = nlohmann::json::parse(ReadWholeFile(output));
  EXPECT_EQ(estimate.at("gravity").at("kind"), "sincos");
  // nothing pulls: the ripple of 0.2 N.m over 480 samples, four times
  EXPECT_NEAR(estimate.at("gravity").at("sine").get<double>(), 0, 4 * 0.2 / std::sqrt(480));

  const ProgramAnswer linear = identify({"--joint", "linear", "--gravity", "sincos"});
  EXPECT_EQ(linear.status, 2);
  EXPECT_THAT(linear.err, HasSubstr("use paired"));
  const ProgramAnswer unable = identify({"--identifier", "stribeck", "--gravity", "sincos"});
  EXPECT_EQ(unable.status, 2);
  EXPECT_THAT(unable.err, HasSubstr("stribeck cannot tell gravity from friction; use one of"));
}

TEST(Identify, WritesAMuJoCoModel) {
  const ScratchDirectory scratch;
  const std::string recording = scratch.path() / "log.csv";
  WriteRecordingFile(recording, 480, SeveralSpeeds);
  const std::string model = scratch.path() / "friction.xml";
  ASSERT_EQ(
      RunWarmjoint({"identify", recording, "--identifier", "nominal-ls", "--mjcf", model}).status,
      0);
  EXPECT_THAT(ReadWholeFile(model), HasSubstr("plugin=\"warmjoint.friction\" actdim=\"2\""));
  EXPECT_THAT(ReadWholeFile(model), HasSubstr("<config key=\"law\" value=\"viscous_coulomb\"/>"));
}

TEST(Identify, AnInadequateModelGivesStatus3AndVoidNumbersOnlyByForce) {
  const ScratchDirectory scratch;
  const std::string recording = scratch.path() / "log.csv", output = scratch.path() / "e.json";
  const std::string model = scratch.path() / "friction.xml";
  WriteRecordingFile(recording, 2400, SeveralSpeeds,
                     [](int i) { return -5.0 * (1 - std::exp(-i / 600.0)); });
  std::vector<std::string> command{"identify", recording, "--identifier", "nominal-ls",
                                   "-o",       output,    "--mjcf",       model};
  const ProgramAnswer answer = RunWarmjoint(command);
  EXPECT_EQ(answer.status, 3) << answer.out;
  EXPECT_THAT(answer.out, HasSubstr("inadequate_model"));
  EXPECT_THAT(answer.out, HasSubstr("held out"));
  auto estimate = nlohmann::json::parse(ReadWholeFile(output));
  EXPECT_TRUE(estimate.at("parameters").at("coulomb").at("interval95").is_null());
  EXPECT_TRUE(estimate.at("friction").is_null());
  EXPECT_FALSE(std::filesystem::exists(model));

  command.push_back("--force");
  const ProgramAnswer forced = RunWarmjoint(command);
  EXPECT_EQ(forced.status, 3);
  EXPECT_THAT(forced.out, HasSubstr("void parameter"));
  estimate = nlohmann::json::parse(ReadWholeFile(output));
  EXPECT_EQ(estimate.at("status"), "inadequate_model");
  EXPECT_THAT(estimate.at("message").get<std::string>(), HasSubstr("all numbers are void"));
  EXPECT_EQ(estimate.at("parameters").at("coulomb").at("interval95").size(), 2u);
  EXPECT_TRUE(std::filesystem::exists(model));
}

/// A script that answers 5 v + coulomb sign(v).
std::string FixedAnswer(double coulomb) {
  return fmt::format(R"(test $(wc -l < $1) -gt 50 || exit 1
cat > $2 <<END
{{"status": "ok", "parameters": {{
   "viscous": {{"value": 5, "unit": "", "std": null, "interval95": null}},
   "coulomb": {{"value": {0}, "unit": "", "std": null, "interval95": null}}}},
 "friction": {{"law": "viscous_coulomb", "parameters": {{"viscous": 5, "coulomb": {0}}}}}}}
END
)",
                     coulomb);
}

TEST(Identify, TriesACommandOnOneRecordingAndJudgesIt) {
  const ScratchDirectory scratch;
  WriteRecordingFile(scratch.path() / "log.csv", 480, SeveralSpeeds);
  WriteWholeFile(scratch.path() / "good.sh", FixedAnswer(15));
  WriteWholeFile(scratch.path() / "bad.sh", FixedAnswer(12));
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(scratch.path());
  const auto identify = [&](const std::string& script, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"identify", "log.csv", "--identifier",
                               "mine=sh " + script + " {recording} {estimate}"});
    return RunWarmjoint(more);
  };
  const ProgramAnswer good = identify("good.sh", {"-o", "estimate.json", "--mjcf", "friction.xml"});
  const ProgramAnswer bad = identify("bad.sh"), crash = identify("none.sh");
  const ProgramAnswer slow = identify("good.sh", {"--set", "time_limit=0.0001"});
  const ProgramAnswer ours = identify("good.sh", {"--gravity", "sincos"});
  const ProgramAnswer follows = identify("good.sh", {"--follows", "log.csv"});
  const ProgramAnswer word = identify("good.sh", {"--set", "time_limi=1"});
  const ProgramAnswer bare = RunWarmjoint({"identify", "log.csv", "--identifier", "mine=good.sh"});
  // beside one of the list: a row for each, also of one that gives no answer
  const std::vector<std::string> several{"--identifier", "nominal-ls", "--identifier",
                                         "gone=sh none.sh {recording} {estimate}"};
  const ProgramAnswer table = identify("good.sh", several);
  auto as_json = several;
  as_json.insert(as_json.end(), {"--format", "json"});
  const auto rows = nlohmann::json::parse(identify("good.sh", as_json).out);
  auto with_file = several;
  with_file.insert(with_file.end(), {"-o", "estimates.json"});
  const ProgramAnswer filed = identify("good.sh", with_file);
  std::filesystem::current_path(before);

  EXPECT_EQ(good.status, 0) << good.err;
  EXPECT_THAT(good.err, HasSubstr("sandbox: "));
  const auto estimate = nlohmann::json::parse(ReadWholeFile(scratch.path() / "estimate.json"));
  EXPECT_EQ(estimate.at("identifier"), "mine");
  EXPECT_EQ(estimate.at("metrics").at("n"), 480);
  EXPECT_LT(estimate.at("holdout").at("n").get<int>(), 480);
  EXPECT_TRUE(std::filesystem::exists(scratch.path() / "friction.xml"));

  // 12 in the place of 15 N.m leaves a residual that depends on direction
  EXPECT_EQ(bad.status, 3);
  EXPECT_THAT(bad.out, HasSubstr("inadequate_model"));
  EXPECT_EQ(crash.status, 3);
  EXPECT_THAT(crash.err, HasSubstr("mine gave no answer (crashed): exit status"));
  EXPECT_EQ(slow.status, 3);
  EXPECT_THAT(slow.err, HasSubstr("(timeout)"));
  EXPECT_EQ(ours.status, 2);
  EXPECT_THAT(ours.err, HasSubstr("--gravity: is for identifiers of the list"));
  EXPECT_EQ(follows.status, 2);
  EXPECT_THAT(follows.err, HasSubstr("--follows: is for identifiers of the list"));
  EXPECT_EQ(word.status, 2);
  EXPECT_THAT(word.err, HasSubstr("did you mean 'time_limit'"));
  EXPECT_EQ(bare.status, 2);
  EXPECT_THAT(bare.err, HasSubstr("lacks {estimate}"));

  EXPECT_EQ(table.status, 0) << table.err;
  EXPECT_THAT(table.out,
              testing::ContainsRegex("mine +ok .*\n.*nominal-ls +ok .*\n.*gone +crashed"));
  EXPECT_THAT(table.out, HasSubstr("coulomb"));
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].at("parameters").at("coulomb").at("value"), 15);
  EXPECT_GT(rows[1].at("holdout").at("rmse").get<double>(), 0);
  EXPECT_EQ(rows[2].at("status"), "crashed");
  EXPECT_EQ(filed.status, 2);
  EXPECT_THAT(filed.err, HasSubstr("--output: is for one identifier"));
}

}  // namespace
}  // namespace warmjoint
