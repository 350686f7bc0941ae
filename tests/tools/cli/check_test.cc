// Several recordings in one `check`, and the project file that describes them.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "tests/tools/cli/in_a_folder.h"
#include "tests/tools/cli/little_files.h"

namespace warmjoint {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class CheckTogether : public InAFolder {
 protected:
  void SetUp() override {
    WriteRecordingFile(at("a.csv"), 480);
    // every other row: half the rate
    std::ifstream rows(at("a.csv"));
    std::string half, line;
    for (int i = 0; std::getline(rows, line); ++i) {
      if (i == 0 || i % 2 == 1) half += line + "\n";
    }
    WriteWholeFile(at("half.csv"), half);
    WriteWholeFile(at("broken.csv"), "time,position\n0,1\n");
  }
};

TEST_F(CheckTogether, EachHasARowAndItsOwnCheck) {
  EXPECT_THAT(Call({"check", "a.csv", "half.csv"}).out,
              AllOf(HasSubstr("a.csv"), HasSubstr("half.csv"), HasSubstr("torque in")));
  const auto told = Json({"check", "a.csv", "half.csv"});
  ASSERT_EQ(told.at("recordings").size(), 2u);
  EXPECT_EQ(told.at("recordings")[0].at("verdict"), "ok");
  EXPECT_EQ(told.at("recordings")[1].at("sampling").at("samples"), 240);
  EXPECT_EQ(told.at("recordings")[1].at("sampling").at("rate"), 0.5);
}

TEST_F(CheckTogether, OneThatCannotBeReadIsTheWorst) {
  const ProgramAnswer text = Program({"check", "a.csv", "broken.csv"});
  EXPECT_EQ(text.status, 2);
  EXPECT_THAT(text.out, AllOf(HasSubstr("unreadable"), HasSubstr("has no column"),
                              HasSubstr("motion      ")));
  const auto told = Json({"check", "broken.csv", "a.csv"});
  EXPECT_EQ(told.at("recordings")[0].at("verdict"), "unreadable");
  EXPECT_EQ(told.at("recordings")[1].at("verdict"), "ok");

  // alone it is refused, and options are refused before any file is read
  EXPECT_THAT(Program({"check", "broken.csv"}).out, Not(HasSubstr("verdict")));
  const ProgramAnswer options = Program({"check", "a.csv", "half.csv", "--gear", "0"});
  EXPECT_EQ(options.status, 2);
  EXPECT_THAT(options.out, Not(HasSubstr("unreadable")));
}

TEST_F(CheckTogether, TellsThatTheFirstCannotBeDrawn) {
  EXPECT_THAT(Refusal({"check", "broken.csv", "a.csv", "--plot", "log.png"}), HasSubstr("log.png"));
  EXPECT_FALSE(std::filesystem::exists(at("log.png")));
}

TEST_F(CheckTogether, RefusesATableThatCannotBeWrittenBeforeItReads) {
  const ProgramAnswer answer =
      Program({"check", "broken.csv", "--segments", "absent/segments.csv"});
  EXPECT_NE(answer.status, 0);
  EXPECT_THAT(answer.err, HasSubstr("absent/segments.csv"));
}

namespace fs = std::filesystem;

/// A log in degrees and in columns of another name, four speeds in both directions, 10 s each.
std::string ForeignLog() {
  std::string text = "t_s,q_deg,dq,force\n";
  double position = 0;
  for (int i = 0; i < 320; ++i) {
    const int side = i / 10 % 2 ? -1 : 1;
    const double v = side * 10.0 * (1 + i / 20 % 4);
    text += fmt::format("{},{},{},{}\n", i, position, v,
                        -(0.05 * v + 15 * side + 0.2 * std::sin(12.9898 * i)));
    position += v;
  }
  return text;
}

constexpr const char* kProject =
    "map: {time: t_s, position: q_deg, velocity: dq, torque: force}\n"
    "unit: {position: deg, velocity: deg/s}\nscale: {torque: -1}\ngear: 100\n";

class TakesProject : public InAFolder {
 protected:
  void SetUp() override {
    fs::create_directory(at("logs"));
    WriteWholeFile(at("logs/log.csv"), ForeignLog());
    WriteWholeFile(at("logs/warmjoint.yaml"), kProject);
  }

  const std::vector<std::string> identify_{"identify",   "logs/log.csv", "--identifier",
                                           "nominal-ls", "-o",           "estimate.json"};
  nlohmann::json Written() const { return JsonFile("estimate.json"); }
};

TEST_F(TakesProject, DescribesTheLogForCheckIdentifyAndPlot) {
  const ProgramAnswer check = Call({"check", "logs/log.csv", "--format", "json"});
  EXPECT_TRUE(nlohmann::json::parse(check.out).is_object()) << "its words go to stderr";
  EXPECT_THAT(check.err, HasSubstr("warmjoint.yaml: map position=q_deg,time=t_s"));
  EXPECT_THAT(check.err, HasSubstr("gear 100 (--no-project leaves it out)\n"));

  Call(identify_);
  const auto estimate = Written();
  // a ripple of 0.2 N.m in place of noise over 320 samples
  EXPECT_NEAR(estimate.at("parameters").at("coulomb").at("value").get<double>(), 15, 0.1);
  EXPECT_EQ(estimate.at("friction").at("gear"), 100);
  EXPECT_EQ(estimate.at("project").at("file"), "logs/warmjoint.yaml");
  EXPECT_EQ(estimate.at("project").at("values").at("scale"), nlohmann::json({"torque=-1"}));
  EXPECT_EQ(estimate.at("recording").at("gear"), 100);

  const ProgramAnswer plot =
      Call({"plot", "estimate.json", "--recording", "logs/log.csv", "-o", "pictures"});
  EXPECT_THAT(plot.err, HasSubstr("warmjoint.yaml: map"));
}

TEST_F(TakesProject, YieldsToTheCommandLine) {
  Call(With(identify_, {"--gear", "7", "--scale", "torque=-2"}));
  const auto estimate = Written();
  EXPECT_EQ(estimate.at("recording").at("gear"), 7);
  EXPECT_NEAR(estimate.at("parameters").at("coulomb").at("value").get<double>(), 30, 0.2);
  EXPECT_FALSE(estimate.at("project").at("values").contains("gear"));
  EXPECT_FALSE(estimate.at("project").at("values").contains("scale"));

  // of a map it keeps the columns that are not named
  const ProgramAnswer other = Program(With(identify_, {"--map", "torque=dq,velocity=force"}));
  EXPECT_EQ(Written().at("recording").at("map").size(), 4u) << other.err;
  EXPECT_THAT(Written().at("recording").at("map"), testing::Contains("torque=dq"));
}

TEST_F(TakesProject, IsLeftOutWhenAsked) {
  EXPECT_THAT(Refusal(With(identify_, {"--no-project"})),
              AllOf(HasSubstr("has no column 'time'"), Not(HasSubstr("warmjoint.yaml"))));
}

TEST_F(TakesProject, RefusesFilesThatDisagreeOrAreNone) {
  WriteWholeFile(at("other.csv"), ForeignLog());
  EXPECT_THAT(Refusal({"check", "logs/log.csv", "other.csv"}),
              HasSubstr("does not lie beside the project file of the other recordings"));
  WriteWholeFile(at("logs/warmjoint.yaml"), "gear: 2\ncommand: touch P\n");
  EXPECT_THAT(Refusal(identify_), HasSubstr("warmjoint.yaml:2: 'command' does not belong here"));
  fs::remove(at("logs/warmjoint.yaml"));
  fs::create_directory(at("logs/warmjoint.yaml"));
  EXPECT_THAT(Program(identify_).err, HasSubstr("is not a regular file"));
}

TEST_F(TakesProject, LetsAnEstimateFindItsRecordingFromAnotherFolder) {
  fs::create_directory(at("estimates"));
  Call({"identify", "logs/log.csv", "--identifier", "nominal-ls", "-o", "estimates/one.json"});
  EXPECT_EQ(JsonFile("estimates/one.json").at("recording").at("files"),
            nlohmann::json({"../logs/log.csv"}));

  // from here, after both have moved, and where the recording came along into its folder
  const auto plots = [&](const std::string& file) {
    return RunWarmjoint({"-q", "plot", file, "-o", at("pictures")}).err;
  };
  EXPECT_EQ(plots(at("estimates/one.json")), "");
  fs::create_directory(at("moved"));
  fs::rename(at("logs"), at("moved/logs"));
  fs::rename(at("estimates"), at("moved/estimates"));
  EXPECT_EQ(plots(at("moved/estimates/one.json")), "");
  fs::rename(at("moved/logs/log.csv"), at("moved/estimates/log.csv"));
  EXPECT_EQ(plots(at("moved/estimates/one.json")), "");
  fs::remove(at("moved/estimates/log.csv"));
  EXPECT_THAT(plots(at("moved/estimates/one.json")), HasSubstr("logs/log.csv is not there"));
}

}  // namespace
}  // namespace warmjoint
