// Every way in which a recording can be unusable: a clear message, exit 2, nothing left behind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/foundation/atomic_file.h"
#include "tests/tools/cli/run_program.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

using testing::HasSubstr;

struct BadRecording {
  std::string name;
  std::string text;
  std::string message;  // part of what must be said
};

void PrintTo(const BadRecording& recording, std::ostream* stream) { *stream << recording.name; }

class BadRecordings : public testing::TestWithParam<BadRecording> {};

TEST_P(BadRecordings, AreRefusedAndLeaveNothingBehind) {
  const ScratchDirectory scratch;
  const std::string recording = scratch.path() / "log.csv";
  WriteWholeFile(recording, GetParam().text);

  const ProgramAnswer check = RunWarmjoint({"check", recording});
  EXPECT_EQ(check.status, 2);
  EXPECT_THAT(check.err, HasSubstr("log.csv"));
  EXPECT_THAT(check.err, HasSubstr(GetParam().message));

  const ProgramAnswer identify =
      RunWarmjoint({"identify", recording, "--identifier", "nominal-ls", "-o",
                    scratch.path() / "e.json", "--mjcf", scratch.path() / "f.xml"});
  EXPECT_EQ(identify.status, 2);
  EXPECT_EQ(identify.out, "");
  EXPECT_EQ(identify.err, check.err);
  for (const auto& entry : std::filesystem::directory_iterator(scratch.path())) {
    EXPECT_EQ(entry.path().filename(), "log.csv") << "left behind";
  }
}

const std::string kHeader = "time,position,velocity,torque\n";

INSTANTIATE_TEST_SUITE_P(
    Kinds, BadRecordings,
    testing::Values(
        BadRecording{"EmptyFile", "", "empty"},
        BadRecording{"MissingColumn", "time,position,velocity\n0,0,1\n1,1,1\n2,2,1\n", "torque"},
        BadRecording{"TextInANumber", kHeader + "0,0,1,2\n1,1,1,2x\n2,2,1,3\n", ":3: "},
        BadRecording{"NaN", kHeader + "0,0,1,2\n1,1,1,nan\n2,2,1,3\n", ":3: "},
        BadRecording{"TimeBackwards", kHeader + "0,0,1,2\n2,1,1,2\n1,2,1,3\n", ":4: "},
        BadRecording{"DuplicateTimes", kHeader + "0,0,1,2\n1,1,1,2\n1,2,1,3\n", ":4: "},
        BadRecording{"TwoSamples", kHeader + "0,0,1,2\n1,1,1,3\n", "at least 3"},
        BadRecording{"NoHeader", "0 s,0,1,2\n1 s,1,1,2\n2 s,2,1,3\n",
                     "its first row is '0 s,0,1,2'. Where that is no header row, add one"},
        BadRecording{"ConstantTorque", kHeader + "0,0,1,2\n1,1,1,2\n2,2,1,2\n", "torque"}),
    [](const auto& suite) { return suite.param.name; });

}  // namespace
}  // namespace warmjoint
