#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/friction.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "identification/identifiers/identifier_list.h"
#include "models/friction/friction_json.h"
#include "tests/support/folders.h"
#include "tests/support/refusal.h"
#include "tests/tools/cli/in_a_folder.h"
#include "tests/tools/cli/little_files.h"
#include "tools/identify/identify_recording.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

using Command = std::vector<std::string>;

class IdentifyCommand : public InAFolder {
 protected:
  IdentifyCommand() { WriteRecordingFile(at("log.csv"), 480); }

  const Command nominal_{"identify", "log.csv", "--identifier", "nominal-ls"};
};

TEST_F(IdentifyCommand, WritesTheContractsJsonAndAFrictionFile) {
  const ProgramAnswer answer = Call(With(nominal_, {"-o", "estimate.json"}));
  EXPECT_THAT(answer.out, HasSubstr("nominal-ls: ok"));
  EXPECT_THAT(answer.out, HasSubstr("held out"));
  const auto estimate = JsonFile("estimate.json");
  EXPECT_EQ(estimate.at("status"), "ok");
  // the ripple of 0.2 N.m stands in for noise: 0.1 is some five standard deviations of the level
  EXPECT_NEAR(estimate.at("parameters").at("coulomb").at("value").get<double>(), 15, 0.1);
  EXPECT_EQ(estimate.at("parameters").at("coulomb").at("unit"), "N.m");
  EXPECT_EQ(estimate.at("parameters").at("coulomb").at("interval95").size(), 2u);
  EXPECT_EQ(estimate.at("metrics").at("n"), 480);
  EXPECT_LT(estimate.at("holdout").at("n").get<int>(), 480);
  EXPECT_EQ(ReadFriction(at("estimate.json")).law, "viscous_coulomb");
}

TEST_F(IdentifyCommand, ReadsStandardInput) {
  const std::string program = test::BuildFolder() / "warmjoint";
  const auto piped = [&](const std::string& command) {
    return RunCommandLine({"sh", "-c", command}, {scratch_.path(), {}});
  };
  const std::string rest = " identify - --identifier nominal-ls --format json";
  const auto file = Json(nominal_);

  // the same numbers through a pipe, also a slow one, and from a redirected file
  for (const std::string& command :
       {"cat log.csv | " + program + rest, program + rest + " < log.csv",
        "(sleep 4; cat log.csv) | " + program + rest}) {
    const ProgramAnswer answer = piped(command);
    ASSERT_EQ(answer.status, 0) << answer.err;
    EXPECT_EQ(nlohmann::json::parse(answer.out).at("parameters"), file.at("parameters"));
  }

  // standard input is no output, and cannot be read again
  const ProgramAnswer both = piped("cat log.csv | " + program + " identify - -o - | head -c 1");
  EXPECT_EQ(both.out, "{") << both.err;
  ASSERT_EQ(piped("cat log.csv | " + program + rest + " -o estimate.json").status, 0);
  EXPECT_THAT(Refusal({"plot", "estimate.json", "-o", "plots"}), HasSubstr("--recording"));
  EXPECT_THAT(piped(program + " check - < /dev/null").err, HasSubstr("standard input"));
}

TEST_F(IdentifyCommand, PrintsTheSameJsonAsItWrites) {
  const Command command{"identify", at("log.csv"), "--identifier", "nominal-ls"};
  auto printed = Json(With(command, {"-o", at("estimate.json")}));
  EXPECT_EQ(printed, JsonFile("estimate.json"));
  EXPECT_EQ(printed.at("recording").at("files"), nlohmann::json({"log.csv"}));
  // once, where both go to standard output, from which no folder of the recording follows
  auto alone = Json(With(command, {"-o", "-"}));
  EXPECT_EQ(alone.at("recording").at("files"), nlohmann::json({at("log.csv")}));
  printed.erase("recording");
  alone.erase("recording");
  EXPECT_EQ(printed, alone);
}

TEST_F(IdentifyCommand, ExplainsEveryTestAndAssumptionWhenAsked) {
  const std::string full = Program(With(nominal_, {"--explain"})).out;
  const auto estimate = Json(nominal_);
  ASSERT_FALSE(estimate.at("diagnostics").empty());
  for (const auto& one : estimate.at("diagnostics")) {
    // a row of its own, or among those that were not made
    const std::string name = one.at("test").get<std::string>();
    EXPECT_THAT(full, HasSubstr(one.at("made").get<bool>() ? "\n" + name + " " : name));
  }
  for (const auto& one : estimate.at("assumptions")) {
    EXPECT_THAT(full, HasSubstr("  " + one.at("name").get<std::string>() + ": "));
  }
  EXPECT_THAT(Program(nominal_).out, Not(HasSubstr("test for lack of fit")));
}

TEST_F(IdentifyCommand, ExplainsItsChoiceByErrorsWhereItHadAny) {
  const Command command{"identify", "log.csv"};
  const auto trials = Json(command).at("choice").at("trials");
  const bool has_errors = std::ranges::any_of(
      trials, [](const auto& one) { return one.contains("rmse") && !one.at("rmse").is_null(); });
  const std::string full = Program(With(command, {"--explain"})).out;
  EXPECT_THAT(full, HasSubstr("\nstructure "));
  EXPECT_EQ(full.find("held-out RMSE") != std::string::npos, has_errors);
}

TEST_F(IdentifyCommand, DoubtsNoUnitThatIsStated) {
  const auto explained = [&](const std::vector<std::string>& more) {
    return Program(With(With(nominal_, {"--explain"}), more)).out;
  };
  EXPECT_THAT(explained({}), HasSubstr("angles_in_radians"));
  EXPECT_THAT(explained({"--unit", "position=rad"}), Not(HasSubstr("angles_in_radians")));
}

TEST_F(IdentifyCommand, HoldsNothingOutWhenAsked) {
  const Command command = With(nominal_, {"-o", "estimate.json", "--holdout"});
  EXPECT_THAT(Program(With(command, {"0"})).out, Not(HasSubstr("held out")));
  EXPECT_TRUE(JsonFile("estimate.json").at("holdout").is_null());
  // another recording of the same joint
  Call(With(command, {"log.csv"}));
  EXPECT_EQ(JsonFile("estimate.json").at("holdout").at("n"), 480);
}

TEST_F(IdentifyCommand, OneSpeedAloneGivesStatus3AndNoNumbers) {
  WriteRecordingFile(at("one.csv"), 400, [](int i) { return i / 20 % 2 ? -0.5 : 0.5; });
  const ProgramAnswer answer = Program(
      {"identify", "one.csv", "--identifier", "energy-ml", "-o", "e.json", "--mjcf", "e.xml"});
  EXPECT_EQ(answer.status, 3);
  EXPECT_THAT(answer.out, HasSubstr("not_identifiable"));
  const auto estimate = JsonFile("e.json");
  EXPECT_EQ(estimate.at("status"), "not_identifiable");
  EXPECT_THAT(estimate.at("message").get<std::string>(), HasSubstr("viscous"));
  EXPECT_TRUE(estimate.at("parameters").empty());
  EXPECT_TRUE(estimate.at("friction").is_null());
  EXPECT_FALSE(std::filesystem::exists(at("e.xml")));
}

TEST_F(IdentifyCommand, TakesSeveralRecordingsAtOnce) {
  WriteRecordingFile(at("other.csv"), 240);
  Call({"identify", "log.csv", "other.csv", "--identifier", "nominal-ls", "-o", "estimate.json"});
  EXPECT_EQ(JsonFile("estimate.json").at("metrics").at("n"), 720);
}

TEST_F(IdentifyCommand, TellsGravityFromFrictionOrSaysWhyNot) {
  const Command gravity{"--gravity", "sincos"};
  EXPECT_THAT(Call(With(With(nominal_, gravity), {"-o", "estimate.json"})).out,
              HasSubstr("gravity_cosine"));
  const auto estimate = JsonFile("estimate.json");
  EXPECT_EQ(estimate.at("gravity").at("kind"), "sincos");
  // nothing pulls: the ripple of 0.2 N.m over 480 samples, four times
  EXPECT_NEAR(estimate.at("gravity").at("sine").get<double>(), 0, 4 * 0.2 / std::sqrt(480));

  EXPECT_THAT(Refusal(With({"identify", "log.csv", "--joint", "linear"}, gravity)),
              HasSubstr("use paired"));
  EXPECT_THAT(Refusal(With({"identify", "log.csv", "--identifier", "kalman"}, gravity)),
              HasSubstr("kalman cannot separate gravity from friction; use one of"));
}

TEST_F(IdentifyCommand, AnInadequateModelGivesStatus3AndVoidNumbersOnlyByForce) {
  WriteRecordingFile(at("log.csv"), 2400, SeveralSpeeds,
                     [](int i) { return -5.0 * (1 - std::exp(-i / 600.0)); });
  const Command command = With(nominal_, {"-o", "e.json", "--mjcf", "friction.xml"});
  const ProgramAnswer answer = Program(command);
  EXPECT_EQ(answer.status, 3) << answer.out;
  EXPECT_THAT(answer.out, HasSubstr("inadequate_model"));
  EXPECT_THAT(answer.out, HasSubstr("held out"));
  auto estimate = JsonFile("e.json");
  EXPECT_TRUE(estimate.at("parameters").at("coulomb").at("interval95").is_null());
  EXPECT_TRUE(estimate.at("friction").is_null());
  EXPECT_FALSE(std::filesystem::exists(at("friction.xml")));

  const ProgramAnswer forced = Program(With(command, {"--force"}));
  EXPECT_EQ(forced.status, 3);
  EXPECT_THAT(forced.out, HasSubstr("void parameter"));
  estimate = JsonFile("e.json");
  EXPECT_EQ(estimate.at("status"), "inadequate_model");
  EXPECT_THAT(estimate.at("message").get<std::string>(), HasSubstr("all numbers are void"));
  EXPECT_EQ(estimate.at("parameters").at("coulomb").at("interval95").size(), 2u);
  EXPECT_TRUE(std::filesystem::exists(at("friction.xml")));
}

TEST(CheckSettings, MakesOfEachSettingTheOptionOfItsName) {
  const struct {
    std::string option, word;
    void (*set)(IdentifySettings& settings);
  } settings[] = {
      {"gravity", "sincos", [](auto& one) { one.gravity = FittedGravity::sincos; }},
      {"motion", "any", [](auto& one) { one.motion = MotionKind::any; }},
      {"initial_energy", "estimated", [](auto& one) { one.start = StartBelief::estimated; }}};
  for (const Identifier& identifier : Identifiers()) {
    for (const auto& [option, word, set] : settings) {
      SCOPED_TRACE(identifier.name + ", " + option);
      IdentifySettings asked;
      asked.identifier = identifier.name;
      set(asked);
      const auto changed = [&] {
        return CheckSettings(asked, JointKind::rotary).options.Changed();
      };
      if (!identifier.options.Has(option)) {
        EXPECT_THAT(test::RefusalOf(changed), HasSubstr("use one of: "));
        continue;
      }
      const std::map<std::string, std::string> expected{{option, word}};
      EXPECT_EQ(changed(), expected);
      // over what --set says of it
      for (const OptionInfo& info : identifier.options.List()) {
        if (info.name == option) asked.options[option] = info.value;
      }
      EXPECT_EQ(changed(), expected);
    }
  }
}

TEST_F(IdentifyCommand, SaysOfEachOfSeveralThatItsFrictionIsInAmperes) {
  const auto all = Json(With(nominal_, {"--identifier", "rls", "--unit", "torque=A"}));
  ASSERT_EQ(all.size(), 2u);
  for (const auto& one : all) EXPECT_EQ(one.at("friction").at("torque_unit"), "A");
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

TEST_F(IdentifyCommand, TriesACommandOnOneRecordingAndJudgesIt) {
  WriteWholeFile(at("good.sh"), FixedAnswer(15));
  WriteWholeFile(at("bad.sh"), FixedAnswer(12));
  WriteWholeFile(at("slow.sh"), "sleep 20\n");
  const auto by = [](const std::string& script) {
    return Command{"identify", "log.csv", "--identifier",
                   "mine=sh " + script + " {recording} {estimate}"};
  };
  const ProgramAnswer good =
      Call(With(by("good.sh"), {"-o", "estimate.json", "--mjcf", "friction.xml"}));
  EXPECT_THAT(good.err, HasSubstr("sandbox: "));
  const auto estimate = JsonFile("estimate.json");
  EXPECT_EQ(estimate.at("identifier"), "mine");
  EXPECT_EQ(estimate.at("metrics").at("n"), 480);
  EXPECT_LT(estimate.at("holdout").at("n").get<int>(), 480);
  EXPECT_TRUE(std::filesystem::exists(at("friction.xml")));

  const struct {
    Command command;
    int status;
    std::string told;
  } others[] = {
      // 12 in the place of 15 N.m leaves a residual that depends on direction
      {by("bad.sh"), 3, "inadequate_model"},
      {by("none.sh"), 3, "mine gave no answer (crashed): exit status"},
      {With(by("slow.sh"), {"--set", "time_limit=0.1"}), 3, "(timeout)"},
      {With(by("good.sh"), {"--gravity", "sincos"}), 2,
       "--gravity: is for identifiers of the list"},
      {With(by("good.sh"), {"--follows", "log.csv"}), 2,
       "--follows: is for identifiers of the list"},
      {With(by("good.sh"), {"--set", "time_limi=1"}), 2, "did you mean 'time_limit'"},
      {{"identify", "log.csv", "--identifier", "mine=good.sh"}, 2, "lacks {estimate}"},
  };
  for (const auto& [command, status, told] : others) {
    const ProgramAnswer answer = Program(command);
    EXPECT_EQ(answer.status, status) << told;
    EXPECT_THAT(answer.out + answer.err, HasSubstr(told));
  }

  // beside one of the list: a row for each, also of one that gives no answer
  const Command several = With(by("good.sh"), {"--identifier", "nominal-ls", "--identifier",
                                               "gone=sh none.sh {recording} {estimate}"});
  const ProgramAnswer table = Call(several);
  EXPECT_THAT(table.out,
              testing::ContainsRegex("mine +ok .*\n.*nominal-ls +ok .*\n.*gone +crashed"));
  EXPECT_THAT(table.out, HasSubstr("coulomb"));
  const auto rows = Json(several);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].at("parameters").at("coulomb").at("value"), 15);
  EXPECT_GT(rows[1].at("holdout").at("rmse").get<double>(), 0);
  EXPECT_EQ(rows[2].at("status"), "crashed");
  EXPECT_THAT(Refusal(With(several, {"-o", "estimates.json"})),
              HasSubstr("--output: is for one identifier"));
}

}  // namespace
}  // namespace warmjoint
