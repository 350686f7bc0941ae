// Several recordings in one `check`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "tests/tools/cli/recording_file.h"
#include "tests/tools/cli/run_program.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

using testing::HasSubstr;
using testing::Not;

double Slow(int i) { return (i / 30 % 2 ? -1 : 1) * 0.2 * (1 + i / 60 % 4); }

class CheckTogether : public testing::Test {
 protected:
  void SetUp() override {
    WriteRecordingFile(scratch_.path() / "a.csv", 480, Slow);
    // every other row: half the rate
    std::ifstream rows(scratch_.path() / "a.csv");
    std::string half, line;
    for (int i = 0; std::getline(rows, line); ++i) {
      if (i == 0 || i % 2 == 1) half += line + "\n";
    }
    WriteWholeFile(scratch_.path() / "half.csv", half);
    WriteWholeFile(scratch_.path() / "broken.csv", "time,position\n0,1\n");
  }

  ProgramAnswer Run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "check");
    return RunWarmjoint(std::move(arguments), Surroundings{scratch_.path(), {}});
  }

  nlohmann::json Json(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--format", "json"});
    return nlohmann::json::parse(Run(std::move(arguments)).out);
  }

  const ScratchDirectory scratch_;
};

TEST_F(CheckTogether, EachHasARowAndItsOwnCheck) {
  const ProgramAnswer text = Run({"a.csv", "half.csv"});
  EXPECT_EQ(text.status, 0);
  EXPECT_THAT(text.out, HasSubstr("torque in"));
  const auto told = Json({"a.csv", "half.csv"});
  ASSERT_EQ(told.at("recordings").size(), 2u);
  EXPECT_EQ(told.at("recordings")[0].at("verdict"), "ok");
  EXPECT_EQ(told.at("recordings")[1].at("sampling").at("samples"), 240);
  EXPECT_EQ(told.at("recordings")[1].at("sampling").at("rate"), 0.5);
}

TEST_F(CheckTogether, OneThatCannotBeReadIsTheWorst) {
  const ProgramAnswer text = Run({"a.csv", "broken.csv"});
  EXPECT_EQ(text.status, 2);
  EXPECT_THAT(text.out, HasSubstr("unreadable"));
  EXPECT_THAT(text.out, HasSubstr("has no column"));
  EXPECT_THAT(text.out, HasSubstr("motion      "));
  const auto told = Json({"broken.csv", "a.csv"});
  EXPECT_EQ(told.at("recordings")[0].at("verdict"), "unreadable");
  EXPECT_EQ(told.at("recordings")[1].at("verdict"), "ok");

  // alone it is refused, and options are refused before any file is read
  EXPECT_THAT(Run({"broken.csv"}).out, Not(HasSubstr("verdict")));
  EXPECT_EQ(Run({"a.csv", "half.csv", "--gear", "0"}).status, 2);
  EXPECT_THAT(Run({"a.csv", "half.csv", "--gear", "0"}).out, Not(HasSubstr("unreadable")));
}

TEST_F(CheckTogether, TellsThatTheFirstCannotBeDrawn) {
  const ProgramAnswer answer = Run({"broken.csv", "a.csv", "--plot", "log.png"});
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.err, HasSubstr("log.png"));
  EXPECT_FALSE(std::filesystem::exists(scratch_.path() / "log.png"));
}

TEST_F(CheckTogether, RefusesATableThatCannotBeWrittenBeforeItReads) {
  const ProgramAnswer answer = Run({"broken.csv", "--segments", "absent/segments.csv"});
  EXPECT_NE(answer.status, 0);
  EXPECT_THAT(answer.err, HasSubstr("absent/segments.csv"));
}

}  // namespace
}  // namespace warmjoint
